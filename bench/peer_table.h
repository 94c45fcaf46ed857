// The comparison as a plain table, as Markdown, and as CSV (comma-separated values).
#pragma once

#include "bench/peer_judge.h"

#include <ostream>

namespace chasles::bench {

/// Seconds per query over the queries of a case.
struct Spread {
    double mean = 0;
    double median = 0;
    double ninety_nine_percent = 0;
    double worst = 0;
};

/// All members are zero if `seconds` is empty.
Spread spread_of(std::vector<double> seconds);

/// The row of one peer on one case. Zero queries mean that the peer gave no answer.
struct PeerRow {
    std::string case_name;
    std::string peer; ///< its name, with the reason if it gave no answer
    Judgement judged;
    Spread time;
    double ratio = 0; ///< of its median to the median of Chasles' first contact on the same queries
};

struct PeerTable {
    std::vector<PeerRow> rows;
    std::vector<AbsentPeer> absent;
};

/// The plain table and the Markdown table end with a legend of their columns.
void print(std::ostream& out, const PeerTable& table);
void print_markdown(std::ostream& out, const PeerTable& table);
void print_csv(std::ostream& out, const PeerTable& table);

} // namespace chasles::bench
