// The comparison as a table: to read, as Markdown, and as CSV.
#pragma once

#include "bench/peer_judge.h"

#include <ostream>

namespace chasles::bench {

/// Seconds over the queries of a case, one number a query.
struct Spread {
    double mean = 0;
    double median = 0;
    double ninety_nine_percent = 0;
    double worst = 0;
};

/// All zeros if there is nothing.
Spread spread_of(std::vector<double> seconds);

/// Without queries, a row is that of a peer without an answer.
struct PeerRow {
    std::string case_name;
    std::string peer; ///< its name, and why there is no answer
    Judgement judged;
    Spread time;
    double ratio = 0; ///< of the median to that of Chasles' first contact on the same queries
};

struct PeerTable {
    std::vector<PeerRow> rows;
    std::vector<AbsentPeer> absent;
};

/// The tables to read say below what their columns are.
void print(std::ostream& out, const PeerTable& table);
void print_markdown(std::ostream& out, const PeerTable& table);
void print_csv(std::ostream& out, const PeerTable& table);

} // namespace chasles::bench
