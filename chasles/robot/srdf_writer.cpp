#include "chasles/robot/srdf_writer.h"

#include "chasles/robot/xml_file.h"

namespace chasles::robot {

namespace {

/// The reason in the words of SRDF files; null for pairs that have to be tested.
const char* reason_of(PairReason reason) {
    switch (reason) {
    case PairReason::never:
        return "Never";
    case PairReason::always:
        return "Always";
    case PairReason::adjacent:
        return "Adjacent";
    default:
        return nullptr;
    }
}

/// Pairs that are enabled stay: adjacent links are not tested otherwise.
void remove_disabled_pairs(tinyxml2::XMLElement& root) {
    for (const char* name : {"disable_collisions", "disable_default_collisions"})
        while (tinyxml2::XMLElement* pair = root.FirstChildElement(name))
            root.DeleteChild(pair);
}

} // namespace

std::string srdf_text(const Robot& robot, const std::vector<PairProof>& proofs, const std::filesystem::path& given) {
    tinyxml2::XMLDocument document;
    if (given.empty()) {
        document.InsertEndChild(document.NewDeclaration());
        document.InsertEndChild(document.NewElement("robot"));
        document.RootElement()->SetAttribute("name", robot.description().name.c_str());
    } else {
        XmlFile(given, "robot").copy_to(document);
        remove_disabled_pairs(*document.RootElement());
    }
    for (const PairProof& proof : proofs)
        if (const char* const reason = reason_of(proof.reason)) {
            tinyxml2::XMLElement* const pair = document.RootElement()->InsertNewChildElement("disable_collisions");
            pair->SetAttribute("link1", proof.first.c_str());
            pair->SetAttribute("link2", proof.second.c_str());
            pair->SetAttribute("reason", reason);
        }
    tinyxml2::XMLPrinter printer;
    document.Print(&printer);
    return printer.CStr();
}

} // namespace chasles::robot
