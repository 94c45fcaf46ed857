#include "view/range_json.h"

#include "view/names.h"

namespace chasles::view {
namespace {

Json values_json(const Configuration& configuration, const std::vector<std::size_t>& joints) {
    Json values = Json::array();
    for (const std::size_t joint : joints)
        values.push_back(configuration[Eigen::Index(joint)]);
    return values;
}

Json boxes_json(const std::vector<ConfigurationBox>& boxes, const std::vector<std::size_t>& joints) {
    Json list = Json::array();
    for (const ConfigurationBox& box : boxes)
        list.push_back({{"lower", values_json(box.lower, joints)}, {"upper", values_json(box.upper, joints)}});
    return list;
}

} // namespace

Json range_json(const chasles::Robot& robot, const RobotRange& found) {
    Json names = Json::array();
    for (const std::size_t joint : found.joints)
        names.push_back(robot.variables()[joint].name);
    Json answer{{"joints", std::move(names)},
                {"verdict", name_of(found.verdict)},
                {"boxes", boxes_json(found.clear, found.joints)},
                {"contact_boxes", boxes_json(found.contact, found.joints)},
                {"open_boxes", boxes_json(found.open, found.joints)},
                {"clear_share", found.clear_share},
                {"contact_share", found.contact_share},
                {"open_share", found.open_share}};
    if (found.witness) {
        answer["witness"] = configuration_json(robot, *found.witness);
        answer["pair"] = {found.pair->first, found.pair->second};
    }
    answer["cells"] = found.cells;
    answer["untested"] = untested_json(*found.untested);
    return answer;
}

Json clear_box_json(const ClearBox& found, const std::vector<std::size_t>& joints) {
    return {{"verdict", name_of(found.verdict)},
            {"lower", values_json(found.box.lower, joints)},
            {"upper", values_json(found.box.upper, joints)},
            {"share", found.share},
            {"is_maximal", found.is_maximal}};
}

} // namespace chasles::view
