# CHASLES_DATA_DIR: real meshes and known answers from outside the project. They lie beside the sources or not at all;
# tests and benchmarks that need them say so and skip where they are absent.
set(data_default "")
foreach(candidate IN ITEMS ${PROJECT_SOURCE_DIR}/shared/data ${PROJECT_SOURCE_DIR}/../shared/data)
  if(NOT data_default AND EXISTS ${candidate}/README.md)
    file(REAL_PATH ${candidate} data_default)
  endif()
endforeach()
set(CHASLES_DATA_DIR "${data_default}" CACHE PATH "Folder of test data from outside the project; may be empty")
