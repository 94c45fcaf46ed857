// A thousand mesh files: real ones, generated ones with slivers, segments, repeated and folded faces, and damaged
// copies of both. Each file is loaded, or refused by one line that names the way out. The small ones that load pass the
// attack: a query against the exact reference of their own faces.
#include "chasles/base/invalid_input.h"
#include "chasles/io/mesh_files.h"
#include "chasles/mesh/polyhedron.h"
#include "tests/attack/any_motion.h"
#include "tests/attack/check_mesh.h"
#include "tests/data/mesh_writers.h"
#include "tests/data/shared_data.h"

#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <sstream>

namespace chasles::test {
namespace {

using attack::AttackRandom;
using attack::MeshCase;
using attack::Shape;
using Path = std::filesystem::path;

constexpr int generated_count = 450;
constexpr int damaged_count = 520;
constexpr std::size_t most_damaged_bytes = 200'000;
constexpr std::size_t most_faces_to_attack = 40;
constexpr double most_seconds = 10; ///< for a file of a few megabytes, on a busy machine

/// A shape of the attack with faces without area, or one with slivers as wide as rounding.
Shape generated_shape(AttackRandom& random) {
    Shape shape = attack::random_shape(random);
    if (random.chance(0.7))
        attack::add_segments(shape, random);
    if (random.chance(0.3))
        shape = attack::shaken(shape, random);
    if (random.chance(0.2)) // a folded face: there and back
        shape.faces.push_back({shape.faces[0][0], shape.faces[0][1], shape.faces[0][2], shape.faces[0][1]});
    if (random.chance(0.1)) // a point
        shape.faces.push_back({shape.faces[0][0], shape.faces[0][0], shape.faces[0][0]});
    return shape;
}

std::string damaged(std::string bytes, AttackRandom& random) {
    if (random.chance(0.3))
        return bytes.substr(0, std::size_t(random.integer(0, int(bytes.size()) - 1)));
    for (int i = random.integer(1, 4); i > 0; --i) {
        char& byte = bytes[std::size_t(random.integer(0, int(bytes.size()) - 1))];
        byte = random.chance(0.5) ? char(random.integer(0, 255)) : "0123456789 -.e\n/"[random.integer(0, 15)];
    }
    return bytes;
}

std::string bytes_of(const Path& file) {
    std::ostringstream bytes;
    bytes << std::ifstream(file, std::ios::binary).rdbuf();
    return bytes.str();
}

/// Writes and finds the files.
class MeshFolder {
public:
    MeshFolder() : folder_(Path(testing::TempDir()) / "chasles-thousand-meshes") {
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    MeshFolder(const MeshFolder&) = delete;
    ~MeshFolder() { std::filesystem::remove_all(folder_); }

    Path write(const std::string& name, const std::string& bytes) {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
        files_.push_back(folder_ / name);
        return files_.back();
    }
    void add_shared() {
        const std::string folder = CHASLES_DATA_DIR;
        if (folder.empty() || !std::filesystem::exists(folder))
            return;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
            if (entry.is_regular_file() && std::regex_match(entry.path().extension().string(), mesh_extension_))
                files_.push_back(entry.path());
        std::ranges::sort(files_);
    }
    void add_generated() {
        for (std::uint64_t i = 0; i < generated_count; ++i) {
            AttackRandom random(5, 1, i);
            const MeshText text = written(generated_shape(random), random.integer(0, mesh_formats - 1));
            write(std::to_string(i) + text.extension, text.bytes);
        }
    }
    void add_damaged() {
        const std::vector<Path> whole = files_;
        for (std::uint64_t i = 0; i < damaged_count; ++i) {
            AttackRandom random(5, 2, i);
            std::string bytes;
            Path from;
            while (bytes.empty() || bytes.size() > most_damaged_bytes) {
                from = random.pick(whole);
                bytes = bytes_of(from);
            }
            write("damaged" + std::to_string(i) + from.extension().string(), damaged(bytes, random));
        }
    }
    [[nodiscard]] const std::vector<Path>& files() const { return files_; }

private:
    Path folder_;
    std::vector<Path> files_;
    std::regex mesh_extension_{R"(\.(obj|off|ply|stl))", std::regex::icase};
};

/// Whether a refusal names what to do: the option that accepts the mesh, or the place in the file to repair.
bool names_the_way_out(const std::string& message) {
    static const std::regex ways("the option triangulate accepts it$|no option accepts this mesh|: line [0-9]+: |"
                                 ": (face|vertex|triangle) [0-9]+: |a mesh needs at least one|is empty$|is truncated: |"
                                 "too short for an STL file|is text, but does not begin with 'solid'|has [0-9]+ "
                                 "additional bytes|: the element '(vertex|face)' needs the ");
    return std::regex_search(message, ways) && message.find('\n') == std::string::npos;
}

/// Loads one file. Empty if it is refused by a proper message.
class Loader {
public:
    int refused = 0;
    int cut = 0; ///< loaded with the option that the refusal names

    std::optional<Polyhedron> load(const Path& file) {
        const Stopwatch watch;
        std::string message = refusal(file, {});
        if (message.ends_with("; the option triangulate accepts it")) {
            ++cut;
            message = refusal(file, {.triangulate = true});
            EXPECT_EQ(message, "") << "the option does not accept it";
        }
        EXPECT_LT(watch.seconds(), most_seconds) << file;
        if (message.empty())
            return std::move(loaded_);
        ++refused;
        EXPECT_TRUE(names_the_way_out(message)) << message;
        EXPECT_TRUE(message.starts_with(file.string() + ": ")) << message;
        return std::nullopt;
    }

private:
    std::string refusal(const Path& file, const PolyhedronOptions& options) {
        try {
            loaded_ = Polyhedron::load(file, options);
            return "";
        } catch (const InvalidInput& error) {
            return error.what();
        }
    }

    std::optional<Polyhedron> loaded_;
};

/// The faces of a file as triangles: the reference has no polygons that are bent or not convex.
Shape triangles_of(const Path& file) {
    io::PolygonSoup soup = io::load_polygons(file);
    Shape shape{std::move(soup.vertices), std::move(soup.faces)};
    attack::cut_into_triangles(shape);
    return shape;
}

TEST(ThousandMeshes, LoadOrNameTheWayOutAndPassTheAttack) {
    MeshFolder folder;
    folder.add_shared();
    const std::size_t shared = folder.files().size();
    folder.add_generated();
    folder.add_damaged();
    Loader loader;
    attack::Tally tally;
    std::optional<Shape> before;
    std::size_t shared_loaded = 0;
    for (std::size_t i = 0; i < folder.files().size(); ++i) {
        const Path& file = folder.files()[i];
        SCOPED_TRACE(file.string());
        const auto body = loader.load(file);
        shared_loaded += body && i < shared ? 1 : 0;
        if (!body || body->face_count() > most_faces_to_attack)
            continue;
        AttackRandom random(5, 3, i);
        Shape shape = triangles_of(file);
        if (before) {
            const MeshCase pair{shape, *before, attack::any_motion(random, 12)};
            const std::string wrong = check(pair, tally);
            EXPECT_EQ(wrong, "") << described(pair);
        }
        before = std::move(shape);
    }
    print_figures("%zu files: %zu of %zu real ones load, %d in all are refused, %d load with the option triangulate; "
                  "%llu attacked, %llu of them touch",
                  folder.files().size(), shared_loaded, shared, loader.refused, loader.cut,
                  static_cast<unsigned long long>(tally.queries), static_cast<unsigned long long>(tally.touches));
    EXPECT_EQ(shared_loaded, shared);
    EXPECT_GT(loader.refused, damaged_count / 4);
    EXPECT_LT(loader.refused, damaged_count);
    EXPECT_GT(loader.cut, 20);
    EXPECT_GT(tally.queries, 400U);
    EXPECT_GT(tally.touches, tally.queries / 4);
    EXPECT_FALSE(tally.is_broken());
}

} // namespace
} // namespace chasles::test
