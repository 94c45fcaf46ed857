#include "bench/peer_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace chasles::bench {

namespace {

const char* const legend =
    "Queries: fewer where a peer is slow. Contacts: how many of them touch. Missed, false alarms: on the peer's own "
    "motion.\nTime error: the worst, of the motion. Times: over the queries, of the median of each. Ratio: of medians, "
    "to "
    "Chasles'\nfirst contact on the same queries.\n";

constexpr std::size_t columns = 12;
using Cells = std::array<std::string, columns>;

const Cells heads{"case",       "peer",    "queries",   "contacts", "missed",   "false alarms",
                  "time error", "mean ms", "median ms", "99 % ms",  "worst ms", "ratio"};

std::string number(const char* format, double value) {
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

std::string milliseconds(double seconds) {
    return seconds > 0 ? number("%.3g", 1e3 * seconds) : "-"; // not timed, by an option of the command line
}

Cells without_numbers(const std::string& case_name, const std::string& peer) {
    Cells cells;
    cells.fill("-");
    cells[0] = case_name;
    cells[1] = peer;
    return cells;
}

Cells cells_of(const PeerRow& row) {
    const auto& [name, peer, judged, time, ratio] = row;
    if (judged.queries == 0)
        return without_numbers(name, peer);
    return {name,
            peer,
            std::to_string(judged.queries),
            std::to_string(judged.contacts),
            std::to_string(judged.missed),
            std::to_string(judged.false_alarms),
            judged.worst_time_error ? number("%.1e", *judged.worst_time_error) : "-",
            milliseconds(time.mean),
            milliseconds(time.median),
            milliseconds(time.ninety_nine_percent),
            milliseconds(time.worst),
            ratio > 0 ? number(ratio < 100 ? "%.2g" : "%.0f", ratio) : "-"};
}

std::vector<Cells> lines_of(const PeerTable& table) {
    std::vector<Cells> lines;
    for (const PeerRow& row : table.rows)
        lines.push_back(cells_of(row));
    for (const AbsentPeer& peer : table.absent)
        lines.push_back(without_numbers("absent", peer.name + " (" + peer.reason + ")"));
    return lines;
}

std::string joined(const Cells& cells, const std::string& between) {
    std::string line = cells[0];
    for (std::size_t i = 1; i < columns; ++i)
        line += between + cells[i];
    return line;
}

} // namespace

Spread spread_of(std::vector<double> seconds) {
    if (seconds.empty())
        return {};
    std::sort(seconds.begin(), seconds.end());
    const auto at = [&](double share) { return seconds[std::size_t(std::ceil(share * double(seconds.size()))) - 1]; };
    return {std::accumulate(seconds.begin(), seconds.end(), 0.0) / double(seconds.size()), at(0.5), at(0.99),
            seconds.back()};
}

void print(std::ostream& out, const PeerTable& table) {
    std::vector<Cells> lines = lines_of(table);
    lines.insert(lines.begin(), heads);
    std::array<std::size_t, columns> widths{};
    for (const Cells& cells : lines)
        for (std::size_t i = 0; i < columns; ++i)
            widths[i] = std::max(widths[i], cells[i].size());
    std::string last_case = lines.front()[0];
    for (Cells cells : lines) {
        if (cells[0] != last_case)
            out << '\n';
        last_case = cells[0];
        for (std::size_t i = 0; i < columns; ++i) {
            const std::string padding(widths[i] - cells[i].size(), ' ');
            cells[i] = i < 2 ? cells[i] + padding : padding + cells[i]; // names to the left, numbers to the right
        }
        out << joined(cells, "  ") << '\n';
    }
    out << '\n' << legend;
}

void print_markdown(std::ostream& out, const PeerTable& table) {
    out << "| " << joined(heads, " | ") << " |\n|---|---|";
    for (std::size_t i = 2; i < columns; ++i)
        out << "--:|";
    out << '\n';
    for (const Cells& cells : lines_of(table))
        out << "| " << joined(cells, " | ") << " |\n";
    out << '\n' << legend;
}

void print_csv(std::ostream& out, const PeerTable& table) {
    out << joined(heads, ",") << '\n';
    for (Cells cells : lines_of(table)) {
        std::replace(cells.begin(), cells.end(), std::string("-"), std::string());
        cells[0] = '"' + cells[0] + '"'; // names contain commas
        cells[1] = '"' + cells[1] + '"';
        out << joined(cells, ",") << '\n';
    }
}

} // namespace chasles::bench
