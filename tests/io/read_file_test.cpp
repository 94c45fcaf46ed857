// Whole files, links and pipes are read; whatever need not end is refused at once.
#include "chasles/io/read_file.h"

#include "chasles/io/mesh_files.h"
#include "tests/io/message_of.h"
#include "tests/io/post_files.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace chasles::io {
namespace {

using tests::message_of;

class ReadFile : public tests::FileTest {
protected:
    [[nodiscard]] std::string message(const std::filesystem::path& file) const {
        return without_folder(message_of([&] { (void)read_file(file); }));
    }
    [[nodiscard]] std::filesystem::path link_to(const std::filesystem::path& target, const std::string& name) const {
        std::filesystem::create_symlink(target, path(name));
        return path(name);
    }
    /// A named pipe, and a thread that writes the text into it `times` times.
    [[nodiscard]] std::jthread pipe(const std::string& name, const std::string& text, std::size_t times = 1) const {
        EXPECT_EQ(::mkfifo(path(name).c_str(), 0600), 0);
        return std::jthread([file = path(name), text, times] {
            std::signal(SIGPIPE, SIG_IGN); // the reader may stop
            std::ofstream out(file, std::ios::binary);
            for (std::size_t i = 0; i < times && out; ++i)
                out << text << std::flush;
        });
    }
};

TEST_F(ReadFile, ReadsEveryByte) {
    const std::string text(300'000, 'v');
    EXPECT_EQ(read_file(write("a.obj", text)), text);
    EXPECT_EQ(read_file(link_to(path("a.obj"), "link.obj")), text);
}

TEST_F(ReadFile, RefusesAPointerOfGitLfsInEveryFormat) {
    const std::string pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n";
    for (const char* const name : {"a.stl", "a.obj", "a.off", "a.ply", "a.glb", "a.gltf", "a.dae", "a.3mf", "a.step"}) {
        const std::filesystem::path file = write(name, pointer);
        EXPECT_EQ(without_folder(message_of([&] { (void)load_polygons(file); })),
                  std::string(name) + ": is a Git LFS pointer, not the file itself; `git lfs pull` brings the content");
    }
    EXPECT_NE(message(write("poses.csv", pointer)).find("Git LFS pointer"), std::string::npos);
}

TEST_F(ReadFile, RefusesDevicesAndLinksToDevices) {
    const std::string why = "is a device, which need not end; give a file or a pipe";
    EXPECT_EQ(message("/dev/zero"), "/dev/zero: " + why);
    EXPECT_EQ(message(link_to("/dev/zero", "zero.obj")), "zero.obj: " + why);
    EXPECT_EQ(message(link_to(path("zero.obj"), "again.stl")), "again.stl: " + why);
    EXPECT_EQ(message("/dev/null"), "/dev/null: " + why);
}

TEST_F(ReadFile, RefusesALinkToItselfAndToNothing) {
    EXPECT_TRUE(message(link_to(path("loop.obj"), "loop.obj")).starts_with("loop.obj: cannot be read: "));
    EXPECT_EQ(message(link_to(path("nothing"), "dangling.obj")), "dangling.obj: no such file");
}

TEST_F(ReadFile, ReadsAPipeToItsEnd) {
    const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    const std::jthread writer = pipe("pipe.obj", text, 10'000);
    EXPECT_EQ(read_file(path("pipe.obj")).size(), text.size() * 10'000);
}

TEST_F(ReadFile, WaitsForTheWriterOfAPipe) {
    EXPECT_EQ(::mkfifo(path("late.obj").c_str(), 0600), 0);
    const std::jthread writer([file = path("late.obj")] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        std::ofstream(file) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    });
    EXPECT_EQ(load_polygons(path("late.obj")).faces.size(), 1U);
}

TEST_F(ReadFile, RefusesAPipeWithoutEnd) {
    const std::jthread writer = pipe("endless.obj", std::string(1 << 16, '#'), std::size_t{1} << 40);
    EXPECT_EQ(message(path("endless.obj")),
              "endless.obj: is a pipe that does not end within 256 MiB; write it to a file first");
}

TEST_F(ReadFile, RefusesAFileThatGrows) {
    std::atomic<bool> is_over = false;
    const std::filesystem::path file = write("growing.obj", "v 0 0 0\n");
    const std::jthread writer([&] {
        std::ofstream out(file, std::ios::app);
        const std::string text(1 << 16, '#');
        for (int i = 0; i < 4'000 && !is_over; ++i)
            out << text << std::flush;
    });
    std::string refusal;
    while (refusal.empty() && std::filesystem::file_size(file) < 4'000 << 16)
        try {
            (void)read_file(file);
        } catch (const InvalidInput& error) {
            refusal = error.what();
        }
    is_over = true;
    EXPECT_EQ(without_folder(refusal), "growing.obj: grows while it is read; wait until it is complete");
}

TEST_F(ReadFile, RefusesAFileBeyondTheMemory) {
    const std::filesystem::path file = write("holes.obj", "v");
    std::error_code error;
    std::filesystem::resize_file(file, std::uintmax_t{1} << 42, error); // takes no space on the disk
    if (error)
        GTEST_SKIP() << "the file system has no files with holes";
    EXPECT_EQ(message(file), "holes.obj: does not fit into memory");
}

TEST_F(ReadFile, ReadsPipesInEveryFormat) {
    const std::jthread writer = pipe("pipe.dae", tests::post_collada("Z_UP"));
    EXPECT_EQ(load_polygons(path("pipe.dae")).faces.size(), 12U);
}

} // namespace
} // namespace chasles::io
