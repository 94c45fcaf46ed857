// Source: docs/decisions/0002-dependencies.md. Aliases make a graph of the text, which is copied as a tree.
#include "cli/yaml_text.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/text_scan.h"

#include <sstream>
#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

namespace chasles::cli {
namespace {

using Json = nlohmann::json;

constexpr int deepest = 32;
constexpr std::size_t nodes_per_byte = 16; ///< a trajectory with aliases has less than one

[[noreturn]] void refuse_depth() {
    throw InvalidInput("is nested more than " + std::to_string(deepest) + " deep");
}

/// The text with LF at the ends of its lines: yaml-cpp takes a lone CR for a character of a line.
std::string with_line_feeds(std::string_view text) {
    std::string lines(text);
    for (std::size_t i = 0; i < lines.size(); ++i)
        if (lines[i] == '\r' && (i + 1 == lines.size() || lines[i + 1] != '\n'))
            lines[i] = '\n';
    return lines;
}

/// Refuses a document that begins where the last one did: yaml-cpp makes such documents without end where one begins
/// with a comma.
class ProgressOfDocuments final : public YAML::EventHandler {
public:
    void OnDocumentStart(const YAML::Mark& mark) override {
        if (mark.pos == begin_)
            throw InvalidInput("is not YAML: line " + std::to_string(mark.line + 1) + ": no value begins here");
        begin_ = mark.pos;
    }
    void OnDocumentEnd() override {}
    void OnNull(const YAML::Mark& /*mark*/, YAML::anchor_t /*anchor*/) override {}
    void OnAlias(const YAML::Mark& /*mark*/, YAML::anchor_t /*anchor*/) override {}
    void OnScalar(const YAML::Mark& /*mark*/, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                  const std::string& /*value*/) override {}
    void OnSequenceStart(const YAML::Mark& /*mark*/, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                         YAML::EmitterStyle::value /*style*/) override {}
    void OnSequenceEnd() override {}
    void OnMapStart(const YAML::Mark& /*mark*/, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                    YAML::EmitterStyle::value /*style*/) override {}
    void OnMapEnd() override {}

private:
    int begin_ = -1;
};

void require_end(const std::string& text) {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    ProgressOfDocuments progress;
    while (parser.HandleNextDocument(progress)) {
    }
}

/// Copies nodes, up to a number.
class TreeOfNodes {
public:
    explicit TreeOfNodes(std::size_t bytes) : left_(1000 + nodes_per_byte * bytes) {}

    Json copy(const YAML::Node& node, int depth = 0) {
        if (depth > deepest)
            refuse_depth();
        if (left_-- == 0)
            throw InvalidInput("has aliases (*NAME) that make much more than the file has");
        if (node.IsSequence())
            return copy_list(node, depth);
        if (node.IsMap())
            return copy_map(node, depth);
        return node.IsScalar() ? Json(node.Scalar()) : Json();
    }

private:
    Json copy_list(const YAML::Node& node, int depth) {
        Json list = Json::array();
        for (const YAML::Node& entry : node)
            list.push_back(copy(entry, depth + 1));
        return list;
    }
    Json copy_map(const YAML::Node& node, int depth) {
        Json map = Json::object();
        for (const auto& entry : node) {
            if (!entry.first.IsScalar())
                throw InvalidInput("has a key that is no text");
            const std::string key = entry.first.Scalar();
            if (!map.emplace(key, copy(entry.second, depth + 1)).second)
                throw InvalidInput("the key " + io::in_quotes(key) + " comes twice in one map");
        }
        return map;
    }

    std::size_t left_;
};

} // namespace

nlohmann::json parse_yaml(const std::string& text) {
    try {
        TreeOfNodes tree(text.size());
        Json documents = Json::array();
        const std::string lines = with_line_feeds(io::without_byte_order_mark(text));
        require_end(lines);
        for (const YAML::Node& document : YAML::LoadAll(lines))
            documents.push_back(tree.copy(document));
        return documents;
    } catch (const YAML::DeepRecursion&) { // the parser's own limit, whose message is "bad file"
        refuse_depth();
    } catch (const YAML::Exception& error) {
        const std::string place = error.mark.is_null() ? "" : "line " + std::to_string(error.mark.line + 1) + ": ";
        throw InvalidInput("is not YAML: " + place + error.msg);
    }
}

} // namespace chasles::cli
