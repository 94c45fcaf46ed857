// Robots: trees of links whose joints move along a path. Does the robot touch its world or itself, when, and where?
// Source: docs/derivations/29-robots.md.
#pragma once

#include "chasles/query/first_contact.h"
#include "chasles/query/least_distance.h"
#include "chasles/robot/joint_path.h"
#include "chasles/robot/robot_description.h"
#include "chasles/scene/scene.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace chasles {

struct ClearBox;
struct ConfigurationBox;
struct RangeOptions;
struct RobotRange;

namespace robot {
class Model;
} // namespace robot

/// One number of a configuration.
struct RobotVariable {
    /// The name of the joint. Planar joints have the variables NAME/x, NAME/y and NAME/theta, floating ones
    /// NAME/trans_x, NAME/trans_y, NAME/trans_z, NAME/rot_x, NAME/rot_y, NAME/rot_z and NAME/rot_w.
    std::string name;
    double lower; ///< -infinity without a limit
    double upper;
    /// Values that differ by 2 pi are the same configuration: of a continuous joint or NAME/theta, if no joint that
    /// follows it slides or turns by a multiplier that is no integer. Straight paths go the shorter way round.
    bool is_continuous;
};

/// A part that moves with a link, for example one that a gripper holds.
struct AttachedPart {
    std::string name; ///< of no link and of no other part
    std::string link;
    Polyhedron shape;
    Pose pose = {};                            ///< in the frame of the link
    std::vector<std::string> touch_links = {}; ///< besides `link`: not tested against the part
};

/// The changes of a robot since it was made from its description. They serve to save a robot and to make it again.
struct RobotChanges {
    using Names = std::pair<std::string, std::string>;
    Pose base = {};                                     ///< where the root link stands in the world
    std::vector<AttachedPart> parts = {};               ///< in the order in which they were attached
    std::vector<Names> ignored = {};                    ///< all links and parts that are not tested against each other
    std::vector<Names> ignored_in_scene = {};           ///< a link or part, and a body of the scene
    std::vector<std::pair<Names, double>> margins = {}; ///< of two links or parts
};

/// Where the files of a robot are.
struct RobotFiles {
    std::filesystem::path srdf = {}; ///< empty: none
    /// package://NAME/REST is the file REST in the folder of NAME, which may have several parts ("vendor/arm"). A
    /// package that is not named here is looked for from the folder of the URDF file upwards: a folder NAME, a folder
    /// whose package.xml says NAME, and at last any folder that has the end of the path.
    std::map<std::string, std::filesystem::path> packages = {};
    /// Cylinders become polyhedra that enclose them and leave them by at most this part of their radius. Spheres and
    /// capsules are exact.
    double primitive_deviation = 0.01;
    Solid solid = Solid::automatic; ///< of meshes; primitives are solid
    double radius = 0; ///< of every collision shape, in the length unit; see PolyhedronOptions::radius. Spheres and
                       ///< capsules grow and shrink by it
};

/// A robot: a kinematic tree with shapes, parts that are attached to it, and pairs that are not tested. Questions may
/// be asked from several threads at a time; changes may not.
class CHASLES_EXPORT Robot {
public:
    /// Reads a URDF file, and an SRDF file if one is named. Throws InvalidInput with file, line, element and reason.
    /// Defined in chasles/robot/srdf_reader.cpp.
    static Robot load(const std::filesystem::path& urdf, const RobotFiles& files = {});

    /// Throws InvalidInput "robot: ELEMENT: WHY" for a description that is no tree, names what does not exist, repeats
    /// a name, or has a value out of its range.
    explicit Robot(RobotDescription description);
    /// The robot that has these changes. Throws InvalidInput as the functions that make the changes.
    Robot(RobotDescription description, const RobotChanges& changes);
    /// Several robots as one, for questions about all of them: a cell. Each robot stands where its base is, below the
    /// root link "world". Its name and a slash come first in all its names, such as left/elbow; the fixed joint at its
    /// base has its name. Parts, ignored pairs and margins are kept. Links of different robots are tested against each
    /// other, unless both stand still whatever the joints do. JointPath::together makes paths. Throws InvalidInput for
    /// no robot, and for a name that is empty, has a slash or comes twice. Source:
    /// docs/derivations/42-several-robots.md.
    static Robot together(const std::vector<std::pair<std::string, Robot>>& robots);
    /// All changes since the robot was made of its description.
    [[nodiscard]] RobotChanges changes() const;

    [[nodiscard]] const RobotDescription& description() const;
    /// What the files of the robot say that has no effect, one line each.
    [[nodiscard]] const std::vector<std::string>& warnings() const { return description().warnings; }
    /// What looks wrong in configurations, one line for each variable: values beyond its limits, and values that look
    /// like degrees. Throws InvalidInput for a wrong number of values.
    [[nodiscard]] std::vector<std::string> warnings_about(std::span<const Configuration> configurations) const;
    /// The variables of the joints that are neither fixed nor mimic another one, in the order of the description.
    [[nodiscard]] std::span<const RobotVariable> variables() const;
    /// Throws InvalidInput for an unknown name.
    [[nodiscard]] std::size_t variable(std::string_view name) const;
    /// Each variable at 0, or at its limit nearest to 0.
    [[nodiscard]] Configuration neutral() const;
    /// A named state of a group of the description; variables of other joints are those of neutral(). Throws
    /// InvalidInput for an unknown name, and without a group for a name that several groups use.
    [[nodiscard]] Configuration state(std::string_view name, std::string_view group = {}) const;

    /// The pose of a link in the world. Throws InvalidInput for an unknown link, and for values as JointPath::straight.
    [[nodiscard]] Pose link_pose(std::string_view link, const Configuration& configuration) const;
    /// The poses of all links, in the order of the description.
    [[nodiscard]] std::vector<Pose> link_poses(const Configuration& configuration) const;
    /// The shapes of all links and parts at a configuration as one rigid body, in the world: vertices are rounded to
    /// doubles, and polygons that rounding bends are cut into triangles. Spheres and capsules are exact if all shapes
    /// have the same radius (as a single one has), unless the body is its surface; otherwise polyhedra enclose them and
    /// leave them by at most a hundredth of their radius. The options are about this body, whatever its shapes are; its
    /// radius is added to what the shapes have. Throws InvalidInput for a robot without shapes, for other shapes with a
    /// radius of which others differ, and as link_pose.
    [[nodiscard]] Polyhedron shape(const Configuration& configuration, const PolyhedronOptions& options = {}) const;

    /// Where the root link stands in the world.
    void set_base(const Pose& pose);
    [[nodiscard]] const Pose& base() const;

    /// The part is tested against the world, and against the links but `link` and `touch_links`. Throws InvalidInput
    /// for a name that is empty or taken, and for an unknown link.
    void attach(const AttachedPart& part);
    /// Throws InvalidInput for an unknown name.
    void detach(std::string_view name);
    [[nodiscard]] std::span<const AttachedPart> attached() const;

    /// Two links or parts are not tested against each other, until `test` is called. At first these are not: a link and
    /// the next one above it that has shapes, and pairs that the description disables. Links that no joint moves
    /// against each other never are. Throws InvalidInput for an unknown name.
    void ignore(std::string_view first, std::string_view second);
    /// Two links or parts are tested against each other, also if they were not at first. Throws InvalidInput for an
    /// unknown name.
    void test(std::string_view first, std::string_view second);
    [[nodiscard]] bool is_tested(std::string_view first, std::string_view second) const;
    /// The names of all links and parts with shapes that are tested against each other, in the order of the
    /// description.
    [[nodiscard]] std::vector<std::pair<std::string, std::string>> tested_pairs() const;
    /// A link or part is not tested against this body of a scene, which need not exist yet. Throws InvalidInput for an
    /// unknown link.
    void ignore_in_scene(std::string_view link, std::string_view body);
    [[nodiscard]] bool is_tested_in_scene(std::string_view link, std::string_view body) const;
    /// The margin of two links or parts, in the place of that of the question. Throws InvalidInput for an unknown name,
    /// and for a margin that is not in [0, 1e30].
    void set_margin(std::string_view first, std::string_view second, double margin);

    /// For the library's own use.
    [[nodiscard]] const robot::Model& model() const { return *model_; }
    explicit Robot(std::shared_ptr<const robot::Model> model) : model_(std::move(model)) {}

private:
    std::shared_ptr<const robot::Model> model_; ///< never changes; a changed robot has another one
};

/// From a stamp of a path on, a part moves with another link. At the stamp its place in the world stays the same. So
/// one robot takes it from another one. On the root link it lies at rest.
struct Handover {
    double stamp = 0; ///< at which a segment of the path ends, and the next one begins
    std::string part; ///< that is attached to the robot
    std::string link; ///< that carries the part from now on. It is not tested against the part, during the whole path
    std::vector<std::string> touch_links = {}; ///< more links and parts that are not, such as fingers
};

/// How to answer a question about a robot.
struct RobotQuery {
    /// With Find::any some contact, not placed in time. `hold` counts for pairs with a greater margin: those that are
    /// within their margin where a segment begins may move on, and are reported where they come within `hold`.
    QueryOptions options = {};
};

/// Two links, parts or bodies of the scene.
struct RobotPair {
    std::string first;           ///< a link or a part
    std::string second;          ///< likewise, or a body of the scene
    bool is_with_scene = false;  ///< the second one is a body of the scene
    std::size_t first_shape = 0; ///< index in LinkDescription::collisions: the shape that the features are of
    std::size_t second_shape = 0;
};

/// The answer for a path of a robot.
struct [[nodiscard]] RobotAnswer {
    Verdict verdict = Verdict::unknown;
    std::size_t segment = 0; ///< of the contact; the last one if clear
    /// Of the contact within the segment, in its stamps (from 0 to 1 for a single segment): `contact.time` has the same
    /// bracket in [0, 1].
    Bracket time;
    bool certain = false;          ///< whether the verdict is proven: always if the path is clear
    std::optional<RobotPair> pair; ///< that touches first
    FirstContact contact;          ///< of the pair: the first one moves. In the world; none if clear
    Configuration configuration;   ///< at the lower end of `time`; at the end of the path if clear
    /// Before this stamp nothing comes within the margin; held pairs do not come within `hold`, or nearer than where
    /// their segment began if that is less.
    double clear_until = 0;
    /// At clear_until: just before contact, so a question that starts there may find one. `hold` lets it go on.
    Configuration clear_configuration;
    std::size_t pairs = 0;                         ///< that were searched, because boxes did not prove them apart
    std::shared_ptr<const UntestedPairs> untested; ///< of the checker: never null in an answer
    Work work;
};

/// How near a robot comes to its world and to itself along a path.
struct [[nodiscard]] RobotClearance {
    Bracket distance;        ///< encloses the least distance, mesh unit; {0, 0} if something touches; infinite if the
                             ///< robot has no pair
    std::size_t segment = 0; ///< of the least distance
    /// When the pair is as near as `distance.upper`, within the segment, in its stamps. Of the first contact in the
    /// segment if something touches.
    Bracket time;
    bool certain = false;          ///< whether the bracket is as narrow as asked; where something touches, proven
    std::optional<RobotPair> pair; ///< that is nearest
    LeastDistance nearest; ///< of the pair, with times of the segment in [0, 1]: the first one moves. In the world
    Configuration configuration;                   ///< at the lower end of `time`
    std::size_t pairs = 0;                         ///< that were searched
    std::shared_ptr<const UntestedPairs> untested; ///< of the checker: never null in an answer
    Work work;
};

/// How near a robot is to its world and to itself over a path.
struct [[nodiscard]] RobotProfile {
    DistanceProfile distance;     ///< the least of all pairs, with stamps of the path as times; infinite without a pair
    std::vector<RobotPair> pairs; ///< what `distance.nearest` counts
    std::shared_ptr<const UntestedPairs> untested; ///< of the checker: never null in an answer
};

/// Of the least distance along a path by its knots: the configurations that the path was made of.
struct [[nodiscard]] RobotGradient {
    /// by_knots(k, i): the derivative by variable i of knot k, mesh unit per radian or per mesh unit. Velocities that
    /// were given with the knots, and times, stay. The last row is that of the goal of an edge. Empty where something
    /// touches, and where no pair is tested.
    Eigen::MatrixXd by_knots;
    /// Whether the least distance has this gradient, as in DistanceGradient.
    bool isolated = false;
};

/// A robot in a world, made ready for many questions: what a planner asks for each of its edges. It keeps the state of
/// the robot and of the scene at the time when it is made. Questions may be asked from several threads at a time. A
/// copy shares what was made ready.
class CHASLES_EXPORT RobotChecker {
public:
    /// `scene` may be null: then the robot is tested against itself only. Throws InvalidInput for an option out of its
    /// range, and for a body of the scene with the name of a link with shapes or of a part.
    explicit RobotChecker(const Robot& robot, const Scene* scene = nullptr, const RobotQuery& query = {});
    ~RobotChecker();
    RobotChecker(const RobotChecker&);
    RobotChecker& operator=(const RobotChecker&);
    RobotChecker(RobotChecker&&) noexcept;
    RobotChecker& operator=(RobotChecker&&) noexcept;

    /// The first contact along a path. Bodies of the scene that move do so during the whole path. Handovers come in the
    /// order of their stamps. Throws InvalidInput "handover I: WHY" for a stamp at which no segment ends, and for an
    /// unknown name.
    [[nodiscard]] RobotAnswer first_contact(const JointPath& path, std::span<const Handover> handovers = {}) const;
    /// Along the straight edge between two configurations.
    [[nodiscard]] RobotAnswer first_contact(const Configuration& start, const Configuration& goal) const;
    /// Whether the straight edge is proven clear. The cheapest question.
    [[nodiscard]] bool is_clear(const Configuration& start, const Configuration& goal) const;
    /// Whether the robot touches nothing at a configuration; false where that cannot be told.
    [[nodiscard]] bool is_clear(const Configuration& configuration) const;
    /// All pairs that touch, or are within the margin, at a configuration where the motions of the scene begin; those
    /// of which that cannot be told, too. Each pair of links is named once, by the first shapes that do.
    [[nodiscard]] std::vector<RobotPair> pairs_in_contact(const Configuration& configuration) const;
    /// Many edges on all cores; `starts` and `goals` have one row an edge. The same answers for any number of threads.
    [[nodiscard]] std::vector<RobotAnswer> first_contacts(const Eigen::MatrixXd& starts, const Eigen::MatrixXd& goals,
                                                          unsigned threads = 0) const;

    /// How near the robot comes to its world and to itself along a path; margins have no effect. Throws InvalidInput
    /// for an option out of its range. Source: docs/derivations/29-robots.md, "Clearance".
    [[nodiscard]] RobotClearance least_distance(const JointPath& path, const LeastDistanceOptions& options = {},
                                                std::span<const Handover> handovers = {}) const;
    /// Along the straight edge between two configurations.
    [[nodiscard]] RobotClearance least_distance(const Configuration& start, const Configuration& goal,
                                                const LeastDistanceOptions& options = {}) const;

    /// The gradient of an answer about this path without handovers. It is computed in double. Throws InvalidInput for a
    /// path of polynomials, which has no knots. Source: docs/derivations/41-gradients.md.
    [[nodiscard]] RobotGradient least_distance_gradient(const JointPath& path, const RobotClearance& clearance) const;

    /// The distance of the nearest pair over a path; margins of the checker have no effect. At a Limit what is proven
    /// so far. Throws InvalidInput for an option out of its range. Source: docs/derivations/39-profile.md, "Many
    /// pairs".
    [[nodiscard]] RobotProfile profile(const JointPath& path, const ProfileOptions& options = {},
                                       std::span<const Handover> handovers = {}) const;

    /// What is clear, in contact or open of all configurations of a box of joints (chasles/robot/range.h). The same
    /// answer for any number of threads, unless time ends the search. `hold` has no effect. Throws InvalidInput for a
    /// box that is none, an option out of its range, and bodies of the scene that move.
    /// Source: docs/derivations/40-ranges.md.
    [[nodiscard]] RobotRange range(const ConfigurationBox& box) const;
    [[nodiscard]] RobotRange range(const ConfigurationBox& box, const RangeOptions& options) const;
    /// A large box around a configuration, within a given one, in which the robot is proven to touch nothing. It grows
    /// evenly first, then side by side; it is not the largest one of all. `tolerance` is the step, as a part of the
    /// given box, by which no side could be moved farther. Throws InvalidInput as `range`, and for a configuration
    /// outside of the box.
    [[nodiscard]] ClearBox clear_box(const ConfigurationBox& within, const Configuration& around) const;
    [[nodiscard]] ClearBox clear_box(const ConfigurationBox& within, const Configuration& around,
                                     const RangeOptions& options) const;

    [[nodiscard]] const Robot& robot() const;
    /// What no answer of the checker looks at.
    [[nodiscard]] const UntestedPairs& untested() const;

    /// For the library's own use.
    struct Prepared;
    [[nodiscard]] const Prepared& prepared() const { return *prepared_; }

private:
    std::shared_ptr<const Prepared> prepared_;
};

} // namespace chasles
