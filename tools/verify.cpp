// Checks a certificate: a text file that proves whether two bodies touch during a motion. What it claims and what each
// step needs to hold is said in the description of the format (certificate.md); the names here are those of that page.
//
//     g++ -std=c++20 -O2 verify.cpp -o verify && ./verify MOVING FIXED CERTIFICATE
//
// Exit status: 0 verified, 1 not verified, 2 usage or a file that cannot be read.
//
// All decisions are made in integers. Lengths are integers in units of 2^unit, where unit is the lowest exponent of all
// lengths of the input; denominators of the motion are cleared once for each piece. Floating point is used only to
// decide clear cases quickly, with error bounds that are stated at the place: see Cell, separates_clearly, winding.

#include "verify.h"

#include <algorithm>
#include <bit>
#include <cfloat>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <boost/multiprecision/cpp_int.hpp>

static_assert(std::numeric_limits<double>::is_iec559 && FLT_EVAL_METHOD == 0, "the error bounds need IEEE doubles");
#ifdef __FAST_MATH__
#error "the error bounds do not hold with -ffast-math"
#endif

namespace certificate {
namespace {

namespace mp = boost::multiprecision;
using std::size_t, std::string, std::uint32_t, std::uint64_t, std::uint8_t, std::vector, std::to_string;
using Word = std::string_view;
using Integer = mp::number<mp::cpp_int_backend<256>, mp::et_off>;  // of any size; up to 256 bits without allocation
using Vector = std::array<Integer, 3>;

constexpr size_t LONGEST_WORD = 1000, MOST_FACES = 1u << 30, MOST_PIECES = 1000000, LARGEST_FILE = size_t(1) << 34;
constexpr int DEEPEST_CELL = 4000;  // halvings

[[noreturn]] void fail(const string& what) { throw std::runtime_error(what); }

string quote(Word word) {
    string text(word.substr(0, 40));
    for (char& c : text) c = c >= ' ' && c <= '~' ? c : '?';
    return "'" + text + (word.size() > 40 ? "...'" : "'");
}

// ---- Integers ----------------------------------------------------------------------------------------------------

std::pair<std::int64_t, int> dyadic(double x) {  // x = mantissa 2^exponent with an odd mantissa, or 0
    if (x == 0) return {0, 0};
    int exponent;
    const std::int64_t mantissa = std::ldexp(std::frexp(x, &exponent), 53);
    const int zeros = std::countr_zero(uint64_t(mantissa));
    return {mantissa >> zeros, exponent - 53 + zeros};
}

template <class Numbers>
int lowest_exponent(const Numbers& numbers, int unit) {
    for (double x : numbers) unit = x == 0 ? unit : std::min(unit, dyadic(x).second);
    return unit;
}

Integer in_units(double x, int unit) {  // of 2^unit, which divides x
    const auto [mantissa, exponent] = dyadic(x);
    return mantissa == 0 ? Integer(0) : Integer(mantissa) << (exponent - unit);
}

Vector in_units(const Corner& c, int u) { return {in_units(c[0], u), in_units(c[1], u), in_units(c[2], u)}; }
Integer dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector operator+(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector operator*(const Integer& s, const Vector& a) { return {s * a[0], s * a[1], s * a[2]}; }
Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
bool is_zero(const Vector& a) { return a[0] == 0 && a[1] == 0 && a[2] == 0; }

double truncated(const Integer& x, long exponent) {  // x 2^exponent, up to 2^-52 of it nearer to 0, if not subnormal
    if (x == 0) return 0;
    const Integer size = abs(x);
    const long cut = std::max(0L, long(msb(size)) - 52);
    const double top = uint64_t(size >> cut), result = std::ldexp(top, std::clamp(cut + exponent, -9999L, 9999L));
    return x < 0 ? -result : result;
}

bool moderate(double x, int exponent) {  // 0 or in [2^-exponent, 2^exponent]
    return x == 0 || (std::abs(x) >= std::ldexp(1, -exponent) && std::abs(x) <= std::ldexp(1, exponent));
}

// ---- SHA-256 (FIPS 180-4) ----------------------------------------------------------------------------------------

class Sha256 {
public:
    void add(uint64_t value, int bytes) {  // little-endian
        for (int i = 0; i < bytes; ++i) add(uint8_t(value >> 8 * i));
    }
    string hexadecimal() {
        const uint64_t bits = 8 * length;
        add(0x80);
        while (length % 64 != 56) add(0);
        for (int i = 56; i >= 0; i -= 8) add(uint8_t(bits >> i));
        string text;
        for (int i = 0; i < 64; ++i) text += "0123456789abcdef"[h[i / 8] >> (28 - i % 8 * 4) & 15];
        return text;
    }

private:
    void add(uint8_t byte) {
        block[length / 4 % 16] = block[length / 4 % 16] << 8 | byte;
        if (++length % 64 == 0) compress();
    }
    static uint32_t mix(uint32_t x, int a, int b, int c) { return std::rotr(x, a) ^ std::rotr(x, b) ^ std::rotr(x, c); }
    void compress() {
        std::array<uint32_t, 64> w;
        std::array<uint32_t, 8> s = h;
        for (int i = 0; i < 64; ++i) {
            w[i] = i < 16 ? block[i] : w[i - 16] + w[i - 7] + (std::rotr(w[i - 15], 7) ^ std::rotr(w[i - 15], 18) ^
                   w[i - 15] >> 3) + (std::rotr(w[i - 2], 17) ^ std::rotr(w[i - 2], 19) ^ w[i - 2] >> 10);
            const uint32_t a = s[7] + mix(s[4], 6, 11, 25) + ((s[4] & s[5]) ^ (~s[4] & s[6])) + K[i] + w[i];
            const uint32_t b = mix(s[0], 2, 13, 22) + ((s[0] & s[1]) ^ (s[0] & s[2]) ^ (s[1] & s[2]));
            s = {a + b, s[0], s[1], s[2], s[3] + a, s[4], s[5], s[6]};
        }
        for (int i = 0; i < 8; ++i) h[i] += s[i];
    }
    static constexpr uint32_t K[64] = {
        0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5, 0xd807aa98,
        0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174, 0xe49b69c1, 0xefbe4786,
        0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da, 0x983e5152, 0xa831c66d, 0xb00327c8,
        0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967, 0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13,
        0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85, 0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819,
        0xd6990624, 0xf40e3585, 0x106aa070, 0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a,
        0x5b9cca4f, 0x682e6ff3, 0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7,
        0xc67178f2};
    std::array<uint32_t, 8> h = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                 0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    std::array<uint32_t, 16> block{};
    uint64_t length = 0;
};

// ---- Words -------------------------------------------------------------------------------------------------------

template <class Number, class... Base>
bool parse(Word word, Number& x, Base... base) {  // the whole word; no sign +
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), x, base...);
    return error == std::errc() && end == word.data() + word.size();
}

struct Reader {
    std::istream& in;
    const bool joins;  // lines that end in a backslash
    string text{};     // of this line
    size_t at = 0, line = 0;

    bool continued() {
        if (text.ends_with('\r')) text.pop_back();
        if (!joins || !text.ends_with('\\')) return false;
        text.back() = ' ';
        return true;
    }
    bool next_line() {  // false at the end of the file
        at = 0, text.clear();
        if (!std::getline(in, text)) return false;
        ++line;
        for (string more; continued() && std::getline(in, more); ++line) text += more;
        text.resize(std::min(text.find('#'), text.size()));
        return true;
    }
    Word optional_word() {  // the next word of this line; empty if there is none
        const auto blank = [&] { return text[at] == ' ' || (text[at] >= '\t' && text[at] <= '\r'); };
        while (at < text.size() && blank()) ++at;
        const size_t start = at;
        while (at < text.size() && !blank()) ++at;
        if (at - start > LONGEST_WORD) fail("a word is too long");
        return Word(text).substr(start, at - start);
    }
    Word word() {  // the next word of this line
        const Word word = optional_word();
        if (word.empty()) fail("a word is missing at the end of the line");
        return word;
    }
    Word any_word() {  // the next word of this or a later line; empty at the end of the file
        Word word = optional_word();
        while (word.empty() && next_line()) word = optional_word();
        return word;
    }
    void expect(Word wanted, Word word) {
        if (word != wanted) fail(quote(wanted) + " expected instead of " + (word.empty() ? "the end" : quote(word)));
    }
    void end_of_line() {
        if (const Word word = optional_word(); !word.empty()) fail("unexpected word " + quote(word));
    }
    size_t number(size_t limit) {  // below the limit
        size_t n;
        const Word digits = word();
        if (!parse(digits, n)) fail("not a number: " + quote(digits));
        if (n >= limit) fail("the number " + quote(digits) + " is out of range");
        return n;
    }
    Integer integer(Word word) {
        std::int64_t small;
        if (parse(word, small)) return small;
        const bool negative = word.starts_with('-');
        if (word.size() == size_t(negative) || word.find_first_not_of("0123456789", negative) != Word::npos)
            fail("not an integer: " + quote(word));
        Integer value = 0;
        for (char c : word.substr(negative)) value = value * 10 + (c - '0');
        return negative ? Integer(-value) : value;
    }
    double real() {  // [-]0xH[.H]p[+-]N, exactly a double
        const Word all = word(), rest = all.substr(all.starts_with('-'));
        const size_t p = std::min(rest.find('p'), rest.size() - 1), point = std::min(rest.find('.'), p);
        string digits(rest.substr(0, p));
        if (point < p) digits.erase(point, 1);
        const bool plus = rest.substr(p + 1).starts_with('+') && !rest.substr(p + 1).starts_with("+-");
        const Word power = rest.substr(p + 1 + plus);
        uint64_t mantissa;
        int exponent;
        if (!digits.starts_with("0x") || digits.find_first_of("ABCDEF") != string::npos ||
            !parse(Word(digits).substr(2), mantissa, 16) || !parse(power, exponent) || std::abs(long(exponent)) > 99999)
            fail("not a hexadecimal number: " + quote(all));
        exponent -= point < p ? 4 * int(p - point - 1) : 0;
        const double x = std::ldexp(double(mantissa), exponent);
        if (!std::isfinite(x) || std::ldexp(x, -exponent) != double(mantissa) ||  // out of range, or rounded
            (mantissa != 0 && mantissa >> std::countr_zero(mantissa) >> 53 != 0))
            fail("not a finite double: " + quote(all));
        return all[0] == '-' ? -x : x;
    }
    double not_negative() {
        const double x = real();
        if (x < 0) fail("a negative number");
        return x + 0.0;  // 0 for -0
    }
    double decimal() {
        double x;
        const Word all = word();
        if (!parse(all.substr(all.starts_with('+') && !all.starts_with("+-")), x) || !std::isfinite(x))
            fail("not a finite decimal number: " + quote(all));
        return x;
    }
    Corner decimal_corner() { return {decimal(), decimal(), decimal()}; }
};

// ---- Bodies ------------------------------------------------------------------------------------------------------

// A range of the order; all nodes are numbered in depth-first order.
struct Node { uint32_t begin, end, number; };

std::pair<Node, Node> halves(const Node& n) {
    const uint32_t middle = n.begin + (n.end - n.begin) / 2;  // = (begin + end) / 2 rounded down
    return {{n.begin, middle, n.number + 1}, {middle, n.end, n.number + 2 * (middle - n.begin)}};
}

struct Body {
    const string name;
    string hash{};
    bool solid = false, is_moderate = true;  // all coordinates are fit for floating point
    vector<Corner> points{};                 // the different corners
    vector<uint32_t> corners{}, order{};     // corners of all faces, as numbers of points
    vector<size_t> first = {0};              // those of face f start at first[f]
    Corner largest = {0, 0, 0};              // absolute coordinates
    vector<vector<uint32_t>> node_points{};  // the different corners of each node, found when needed
    vector<uint32_t> part{};                 // for each point the point that stands for its connected part
    vector<bool> proven{};                   // for each part (its point) whether it is outside

    void read(const Mesh& mesh) {
        if (mesh.empty() || mesh.size() >= MOST_FACES) fail("the " + name + " body has no faces or too many");
        Sha256 sha;
        for (const auto& face : mesh) {
            if (face.size() < 3) fail("a face of the " + name + " body has less than three corners");
            sha.add(face.size(), 4);
            for (Corner c : face) {
                for (size_t i = 0; i < 3; ++i) {
                    if (!std::isfinite(c[i])) fail("a coordinate of the " + name + " body is not finite");
                    sha.add(std::bit_cast<uint64_t>(c[i] += 0.0), 8);  // 0 for -0
                    largest[i] = std::max(largest[i], std::abs(c[i]));
                    is_moderate = is_moderate && moderate(c[i], 200);
                }
                points.push_back(c);
            }
            first.push_back(points.size());
        }
        hash = sha.hexadecimal();
        const vector<Corner> all = points;
        if (all.size() >= 4 * MOST_FACES - 1) fail("the " + name + " body has too many corners");
        std::sort(points.begin(), points.end());
        points.erase(std::unique(points.begin(), points.end()), points.end());
        for (const Corner& c : all)
            corners.push_back(std::lower_bound(points.begin(), points.end(), c) - points.begin());
    }

    size_t faces() const { return first.size() - 1; }
    size_t size(size_t face) const { return first[face + 1] - first[face]; }
    const Corner& corner(size_t face, size_t k) const { return points[corners[first[face] + k]]; }

    // Every edge of a solid occurs once in each of the two directions, in two faces.
    void check_solid() const {
        vector<uint64_t> edges;
        for (size_t f = 0; f < faces(); ++f) {
            vector<uint32_t> c(corners.begin() + first[f], corners.begin() + first[f + 1]);
            for (size_t k = 0; k < c.size(); ++k) edges.push_back(uint64_t(c[k]) << 32 | c[(k + 1) % c.size()]);
            std::sort(c.begin(), c.end());
            if (std::adjacent_find(c.begin(), c.end()) != c.end())
                fail("face " + to_string(f) + " of the solid " + name + " body has a corner twice");
        }
        std::sort(edges.begin(), edges.end());
        if (std::adjacent_find(edges.begin(), edges.end()) != edges.end())
            fail("two faces of the solid " + name + " body have an edge in the same direction");
        for (uint64_t edge : edges)
            if (!std::binary_search(edges.begin(), edges.end(), std::rotl(edge, 32)))
                fail("an edge of the solid " + name + " body has a face at one side only");
    }

    void find_parts() {
        part.resize(points.size());
        std::iota(part.begin(), part.end(), 0);
        const auto root = [&](uint32_t p) {
            while (part[p] != p) p = part[p] = part[part[p]];
            return p;
        };
        for (size_t f = 0; f < faces(); ++f)
            for (size_t k = first[f]; k < first[f + 1]; ++k) part[root(corners[k])] = root(corners[first[f]]);
        for (uint32_t& p : part) p = root(p);
        proven.resize(points.size(), false);
    }

    const vector<uint32_t>& points_of(const Node& node) {
        auto& list = node_points[node.number];
        if (!list.empty()) return list;
        for (size_t i = node.begin; i < node.end; ++i)
            list.insert(list.end(), corners.begin() + first[order[i]], corners.begin() + first[order[i] + 1]);
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
        list.shrink_to_fit();
        return list;
    }
};

// ---- Motion ------------------------------------------------------------------------------------------------------

struct Quaternion {
    Integer w;
    Vector v;
    Integer norm() const { return w * w + dot(v, v); }
    Vector rotate(const Vector& y) const {  // q y q^-1, times norm()
        return (w * w - dot(v, v)) * y + 2 * dot(v, y) * v + 2 * w * cross(v, y);
    }
};

struct Pose {
    Corner position;
    std::array<double, 4> q;
    Quaternion quaternion() const {  // times a power of two, which changes nothing
        const int u = lowest_exponent(q, 1023);
        return {in_units(q[0], u), {in_units(q[1], u), in_units(q[2], u), in_units(q[3], u)}};
    }
};

Quaternion turn(const Quaternion& q0, const Quaternion& q1) {  // q1 q0^-1 or its negative, times |q0|^2
    const Integer w = q1.w * q0.w + dot(q1.v, q0.v), sign = w < 0 ? -1 : 1;
    if (w == 0) fail("a piece is half a turn");
    return {sign * w, sign * (q0.w * q1.v - q1.w * q0.v - cross(q1.v, q0.v))};
}

// The numbers that make W p and W of a corner b: coordinate i of W p is the sum of [4 i + k] b_k over k = 0, 1, 2, and
// [4 i + 3]; W is [12].
constexpr size_t COLUMNS = 13, W = 12;
template <class Number>
using Cubic = std::array<std::array<Number, COLUMNS>, 4>;  // coefficients of powers, or of Bernstein polynomials

// W p and W of a piece in powers of tau / end, times a common factor: w w vv |q0|^2, where vv is v . v, or 1 if v = 0.
// With the numerators along' = along vv, across' = across vv and m' = 2 w vv m, all terms are integers.
Cubic<Integer> motion_of(const Pose& from, const Pose& to, double end, int unit) {
    const Quaternion q0 = from.quaternion();
    const auto [w, v] = turn(q0, to.quaternion());
    const Integer square = dot(v, v), vv = square == 0 ? Integer(1) : square, norm = q0.norm(), ww = w * w;
    const Vector t0 = in_units(from.position, unit), q = in_units(to.position, unit) - t0;
    const Vector along = square == 0 ? q : dot(v, q) * v, across = vv * q - along, m = w * across - cross(v, across);
    Cubic<Integer> c{};
    const auto set_column = [&](size_t k, const std::array<Vector, 4>& column) {
        for (size_t power = 0; power < 4; ++power)
            for (size_t i = 0; i < 3; ++i) c[power][4 * i + k] = column[power][i];
    };
    for (size_t k = 0; k < 3; ++k) {
        const Vector y = q0.rotate({k == 0, k == 1, k == 2}), vy = cross(v, y);
        set_column(k, {ww * vv * y, 2 * w * vv * vy, vv * (square * y + 2 * cross(v, vy)), Vector{}});
    }
    set_column(3, {ww * vv * norm * t0, norm * (ww * along + w * m), norm * (vv * square * t0 + cross(v, m)),
                   norm * square * along});
    c[0][W] = ww * vv * norm;
    c[2][W] = square * vv * norm;
    const auto [mantissa, exponent] = dyadic(end);  // at most 1, so that the exponent is at most 0
    Integer factor = 1;
    for (int power = 0; power < 4; ++power, factor *= mantissa)
        for (Integer& x : c[power]) x = (x * factor) << (3 - power) * -exponent;
    return c;
}

// Three times 8^depth times the Bernstein coefficients on [index, index + 1] / 2^depth.
Cubic<Integer> bernstein(const Cubic<Integer>& c, const Integer& index, int depth) {
    Cubic<Integer> b;
    for (size_t k = 0; k < COLUMNS; ++k) {  // a0 + a1 x + a2 x^2 + a3 x^3 for tau = (index + x) / 2^depth
        const Integer c1 = c[1][k] << 2 * depth, c2 = c[2][k] << depth, a3 = c[3][k], c3 = a3 * index;
        const Integer a0 = 3 * ((c[0][k] << 3 * depth) + index * (c1 + index * (c2 + c3)));
        const Integer a1 = c1 + index * (2 * c2 + 3 * c3), a2 = c2 + 3 * c3;
        b[0][k] = a0, b[1][k] = a0 + a1, b[2][k] = a0 + 2 * a1 + a2, b[3][k] = a0 + 3 * (a1 + a2 + a3);
    }
    return b;
}

// A part of the piece. In floating point the coefficients of the whole piece are truncated, which errs by at most
// 2 u of their absolute value, u = 2^-53; each halving takes up to three means after another, each of which adds at
// most u of the largest coefficient of that column. After `depth` halvings they err by at most (3 depth + 2) u of the
// largest one of the column of the whole piece, and none is larger than that one.
struct Cell {
    int depth = 0;
    Integer index = 0;
    Cubic<double> rounded{};
    std::unique_ptr<Cubic<Integer>> exact{};  // made when needed
};

std::pair<Cell, Cell> halves(const Cell& cell) {
    Cell low{cell.depth + 1, 2 * cell.index}, high{cell.depth + 1, 2 * cell.index + 1};
    for (size_t k = 0; k < COLUMNS; ++k) {  // de Casteljau
        const double b0 = cell.rounded[0][k], b1 = cell.rounded[1][k], b2 = cell.rounded[2][k], b3 = cell.rounded[3][k];
        const double b01 = (b0 + b1) / 2, b12 = (b1 + b2) / 2, b23 = (b2 + b3) / 2;
        const double b012 = (b01 + b12) / 2, b123 = (b12 + b23) / 2, middle = (b012 + b123) / 2;
        low.rounded[0][k] = b0, low.rounded[1][k] = b01, low.rounded[2][k] = b012, low.rounded[3][k] = middle;
        high.rounded[0][k] = middle, high.rounded[1][k] = b123, high.rounded[2][k] = b23, high.rounded[3][k] = b3;
    }
    return {std::move(low), std::move(high)};
}

// ---- The certificate ---------------------------------------------------------------------------------------------

struct Checker {
    Reader& in;
    Body moving{"moving"}, fixed{"fixed"};
    string solid{}, verdict{};
    std::array<double, 2> radii{};
    double margin = 0, lower = 0, upper = 0;
    size_t contact_piece = 0, steps = 0;
    vector<Pose> poses{};
    int unit = 0;                            // of lengths, as a power of two
    Integer reach = 0;                       // D
    std::array<Integer, COLUMNS> place{};    // of the moving body for the witness
    bool filter = false;                     // this and the following: see prepare_filter
    double rounded_reach = 0, size_of_w = 0;
    Corner size{};

    string check(const Mesh& moving_mesh, const Mesh& fixed_mesh) {
        moving.read(moving_mesh);
        fixed.read(fixed_mesh);
        read_head();
        const bool start = verdict == "start";
        for (Body* body : {&moving, &fixed})
            if (!start) read_order(*body);
        Word word = in.any_word();
        if (!start) word = check_outside(word);
        const size_t proofs = start ? 0 : verdict == "clear" ? poses.size() - 1 : contact_piece + 1;
        for (size_t piece = 0; piece < proofs; ++piece, word = in.any_word()) {
            in.expect("proof", word);
            if (in.number(poses.size()) != piece) fail("the proof of piece " + to_string(piece) + " is missing");
            in.end_of_line();
            check_proof(piece, verdict == "contact" && piece == contact_piece ? lower : 1);
            in.end_of_line();
        }
        if (verdict != "clear") {
            in.expect("witness", word);
            check_witness();
            in.end_of_line();
            word = in.any_word();
        }
        if (!word.empty()) fail("unexpected word " + quote(word) + " after the end");
        return claims();
    }

    template <class Use>
    void line(Word keyword, const Use& read) {
        in.expect(keyword, in.any_word());
        read();
        in.end_of_line();
    }

    void read_head() {
        line("chasles", [&] { in.expect("certificate", in.word()), in.expect("1", in.word()); });
        for (Body* body : {&moving, &fixed})
            line(body->name, [&] {
                if (in.word() != body->hash) fail("the hash is that of another " + body->name + " body");
                if (in.number(MOST_FACES) != body->faces()) fail("wrong number of faces");
            });
        line("solid", [&] {
            solid = in.word();
            moving.solid = solid == "moving" || solid == "both";
            fixed.solid = solid == "fixed" || solid == "both";
            if (!moving.solid && !fixed.solid && solid != "none") fail("unknown word " + quote(solid));
        });
        for (const Body* body : {&moving, &fixed})
            if (body->solid) body->check_solid();
        line("radius", [&] { radii[0] = in.not_negative(), radii[1] = in.not_negative(); });
        line("margin", [&] { margin = in.not_negative(); });
        line("motion", [&] {
            in.expect("screw", in.word());
            poses.resize(in.number(MOST_PIECES + 1) + 1);
            if (poses.size() == 1) fail("a motion without a piece");
        });
        unit = lowest_exponent(std::array{radii[0], radii[1], margin}, 0);
        for (Pose& pose : poses) {
            line("pose", [&] {
                for (double& x : pose.position) x = in.real();
                for (double& x : pose.q) x = in.real();
                if (pose.q == std::array<double, 4>{}) fail("a quaternion of length 0");
            });
            unit = lowest_exponent(pose.position, unit);
            if (&pose != &poses[0]) turn((&pose - 1)->quaternion(), pose.quaternion());  // refuses half a turn
        }
        for (const Corner& c : moving.points) unit = lowest_exponent(c, unit);
        for (const Corner& c : fixed.points) unit = lowest_exponent(c, unit);
        reach = in_units(radii[0], unit) + in_units(radii[1], unit) + in_units(margin, unit);
        line("verdict", [&] {
            verdict = in.word();
            if (verdict == "clear" || verdict == "start") return;
            if (verdict != "contact") fail("unknown verdict " + quote(verdict));
            contact_piece = in.number(poses.size() - 1), lower = in.not_negative(), upper = in.not_negative();
            if (!(lower <= upper && upper <= 1)) fail("LOWER and UPPER are not in order in [0, 1]");
        });
    }

    void read_order(Body& body) {
        body.node_points.resize(2 * body.faces() - 1);
        line("order", [&] {
            in.expect(body.name, in.word());
            vector<bool> used(body.faces(), false);
            for (size_t i = 0; i < body.faces(); ++i) {
                body.order.push_back(in.number(body.faces()));
                if (used[body.order[i]]) fail("face " + to_string(body.order[i]) + " is twice in the order");
                used[body.order[i]] = true;
            }
        });
    }

    Body& read_side() {
        const Word word = in.word();
        if (word != "moving" && word != "fixed") fail("unknown body " + quote(word));
        return word == "moving" ? moving : fixed;
    }
    const Body& other(const Body& body) const { return &body == &moving ? fixed : moving; }

    // ---- Inside and outside --------------------------------------------------------------------------------------

    // Reads F C X Y Z and counts how often the other body, a solid, winds around this corner at the start.
    long read_winding(const Body& body, uint32_t& point) {
        if (!other(body).solid) fail("the other body is not solid");
        const size_t face = in.number(body.faces());
        point = body.corners[body.first[face] + in.number(body.size(face))];
        Vector direction;
        for (Integer& x : direction) x = in.integer(in.word());
        if (is_zero(direction)) fail("a direction that is 0");
        const Quaternion q0 = poses[0].quaternion(), back = {-q0.w, q0.v};
        const Vector c = in_units(body.points[point], unit), t0 = in_units(poses[0].position, unit);
        // in the frame of the other body, times the norm
        const Vector origin = &body == &moving ? q0.norm() * t0 + q0.rotate(c) : back.rotate(c - t0);
        return winding(other(body), origin, q0.norm(), direction);
    }

    // Along the ray from origin / norm. The line of the ray goes through the inside of a triangle if the products
    // s = direction . ((p - origin) x (q - origin)) of its three edges p, q have the same sign, and misses it if two of
    // them have different signs.
    //
    // The filter decides the latter: let `most` be at least the absolute value of each coordinate. The coordinates of
    // the origin err by 2^-50 most (two truncations, a division), those of p - origin by 2^-49 most, and are at most
    // 2 most. So those of the cross product, at most 8 most^2, err by less than 2^-45 most^2, and s by less than
    // 2^-44 most^2 (|x| + |y| + |z|), rounding of the direction and of the sum included. `error` is twice as much.
    long winding(const Body& body, const Vector& origin, const Integer& norm, const Vector& direction) const {
        Corner o, d;
        double most = 0;
        bool usable = body.is_moderate;
        for (size_t i = 0; i < 3; ++i) {
            const long scale = msb(norm);
            o[i] = truncated(origin[i], unit - scale) / truncated(norm, -scale), d[i] = truncated(direction[i], 0);
            most = std::max({most, body.largest[i], std::abs(o[i]) * (1 + 0x1p-49)});
            usable = usable && moderate(o[i], 200) && moderate(d[i], 100);
        }
        const double error = 0x1p-43 * most * most * (std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]));
        const auto product = [&](const Corner& p, const Corner& q) {
            const double x = p[0] - o[0], y = p[1] - o[1], z = p[2] - o[2];
            const double r = q[0] - o[0], s = q[1] - o[1], t = q[2] - o[2];
            return d[0] * (y * t - z * s) + d[1] * (z * r - x * t) + d[2] * (x * s - y * r);
        };
        long count = 0;
        for (size_t f = 0; f < body.faces(); ++f)
            for (size_t k = 1; k + 1 < body.size(f); ++k) {
                const Corner &a = body.corner(f, 0), &b = body.corner(f, k), &c = body.corner(f, k + 1);
                const auto [low, high] = std::minmax({product(a, b), product(b, c), product(c, a)});
                if (usable && low < -error && high > error) continue;
                const auto from_origin = [&](const Corner& x) { return norm * in_units(x, unit) - origin; };
                count += crossing({from_origin(a), from_origin(b), from_origin(c)}, direction, f);
            }
        return count;
    }

    static int crossing(const std::array<Vector, 3>& p, const Vector& direction, size_t face) {
        int positive = 0, negative = 0;
        for (size_t i = 0; i < 3; ++i) {
            const int sign = dot(direction, cross(p[i], p[(i + 1) % 3])).sign();
            positive += sign > 0, negative += sign < 0;
        }
        if (positive > 0 && negative > 0) return 0;
        const string where = " face " + to_string(face) + " of the other body and proves nothing";
        if (positive + negative == 0) fail("the ray is in the plane of" + where);
        // The line meets the triangle at the distance height / slope; the slope has the sign of the products.
        const int height = dot(cross(p[1] - p[0], p[2] - p[0]), p[0]).sign();
        if (height == 0) fail("the corner is on" + where);
        if ((height > 0) != (positive > 0)) return 0;  // behind the corner
        if (positive + negative < 3) fail("the ray meets an edge of" + where);
        return positive > 0 ? 1 : -1;
    }

    Word check_outside(Word word) {  // returns the first word of the line after these
        for (Body* body : {&moving, &fixed})
            if (other(*body).solid) body->find_parts();
        for (uint32_t point; word == "outside"; word = in.any_word()) {
            Body& body = read_side();
            if (read_winding(body, point) > 0) fail("the corner is inside of the other body");
            in.end_of_line();
            body.proven[body.part[point]] = true;
        }
        for (const Body* body : {&moving, &fixed})
            for (uint32_t p : body->part)
                if (!body->proven[p]) fail("a part of the " + body->name + " body has no line 'outside'");
        return word;
    }

    // ---- Proof ---------------------------------------------------------------------------------------------------

    void check_proof(size_t piece, double end) {
        struct Task { Node moving, fixed; size_t cell; };
        const Cubic<Integer> motion = motion_of(poses[piece], poses[piece + 1], end, unit);
        vector<Cell> cells(1);  // of the tasks: the cell of a task is never behind that of a later one
        prepare_filter(cells[0], bernstein(motion, 0, 0));
        vector<Task> tasks = {{{0, uint32_t(moving.faces()), 0}, {0, uint32_t(fixed.faces()), 0}, 0}};
        for (size_t step = 1; !tasks.empty(); ++step, ++steps) {
            const auto [a, b, number] = tasks.back();
            tasks.pop_back();
            cells.erase(cells.begin() + number + 1, cells.end());
            Cell& cell = cells[number];
            const auto refuse = [&](const string& what) {
                fail("step " + to_string(step) + " of piece " + to_string(piece) + ": " + what);
            };
            const Word word = in.any_word();
            if (word == "P") {
                Vector n;
                for (Integer& x : n) x = in.integer(in.any_word());
                if (is_zero(n)) refuse("the normal is 0");
                if (!separates(n, moving.points_of(a), fixed.points_of(b), cell, motion))
                    refuse("the nodes are not on both sides of the plane");
            } else if (word == "T") {
                if (cell.depth == DEEPEST_CELL) refuse("too many halvings of tau");
                auto [low, high] = halves(cell);
                cells.push_back(std::move(high));
                cells.push_back(std::move(low));
                for (size_t half : {1, 2}) tasks.push_back({a, b, number + half});
            } else if (word == "A" || word == "B") {
                const Node& node = word == "A" ? a : b;
                if (node.end - node.begin == 1) refuse("a node of one face has no parts");
                const auto [first, second] = halves(node);
                for (const Node& half : {second, first})
                    tasks.push_back({word == "A" ? half : a, word == "B" ? half : b, number});
            } else {
                refuse(word == "?" ? "the certificate is incomplete here" : "not a step: " + quote(word));
            }
        }
    }

    // The filter is used if all numbers of the piece are 0 or in [2^-300, 2^300], and those of the bodies and the reach
    // 0 or in [2^-200, 2^200]. Numbers of 53 bits are multiples of 2^-352 and 2^-252 then, those of cells of at most 64
    // halvings of 2^-544, and products of both of 2^-796: so nothing underflows. Nothing overflows either.
    void prepare_filter(Cell& cell, const Cubic<Integer>& exact) {
        rounded_reach = truncated(reach, unit);
        filter = moving.is_moderate && fixed.is_moderate && moderate(rounded_reach, 200);
        std::array<double, COLUMNS> most{};  // of the piece
        for (size_t j = 0; j < 4; ++j)
            for (size_t k = 0; k < COLUMNS; ++k) {  // [3], [7] and [11] are lengths
                const double x = truncated(exact[j][k], (k % 4 == 3 ? unit : 0) - long(msb(exact[0][W])));
                filter = filter && moderate(x, 300);
                cell.rounded[j][k] = x, most[k] = std::max(most[k], std::abs(x));
            }
        for (size_t i = 0; i < 3; ++i)
            size[i] = most[4 * i] * moving.largest[0] + most[4 * i + 1] * moving.largest[1] +
                      most[4 * i + 2] * moving.largest[2] + most[4 * i + 3] + fixed.largest[i] * most[W];
        size_of_w = most[W];
    }

    bool separates(const Vector& n, const vector<uint32_t>& moving_points, const vector<uint32_t>& fixed_points,
                   Cell& cell, const Cubic<Integer>& motion) const {
        if (separates_clearly(n, moving_points, fixed_points, cell)) return true;
        if (!cell.exact) cell.exact = std::make_unique<Cubic<Integer>>(bernstein(motion, cell.index, cell.depth));
        const Integer square = dot(n, n);
        Integer s = sqrt(square), d = dot(n, in_units(fixed.points[fixed_points[0]], unit));
        if (s * s < square) ++s;
        for (uint32_t p : fixed_points) d = std::max(d, dot(n, in_units(fixed.points[p], unit)));
        d += s * reach;
        for (const auto& b : *cell.exact) {
            Vector row;
            for (size_t k = 0; k < 3; ++k) row[k] = n[0] * b[k] + n[1] * b[4 + k] + n[2] * b[8 + k];
            const Integer constant = n[0] * b[3] + n[1] * b[7] + n[2] * b[11] - d * b[W];
            for (uint32_t p : moving_points)
                if (dot(row, in_units(moving.points[p], unit)) + constant <= 0) return false;
        }
        return true;
    }

    // Whether all Bernstein coefficients are above 0 by more than all errors of rounding. With u = 2^-53 and S the sum
    // of the absolute values of all terms, which is at most the `sum` below, the errors are at most
    //   (3 depth + 2) u S  of the coefficients on the cell (see Cell),
    //   3 u S              of the products with n, three products and two sums; likewise of n . c,
    //   4 u S              of the reach (truncated: 2 u), its product with s and the sum with d,
    //   6 u S              of the products with a corner or W and of the sums,
    // together less than (3 depth + 16) u S, effects of the second order included. `sum` itself errs by less than
    // 20 u. (depth + 8) 2^-51 sum = (4 depth + 32) u sum is more. Fused operations would only make errors smaller.
    bool separates_clearly(const Vector& normal, const vector<uint32_t>& moving_points,
                           const vector<uint32_t>& fixed_points, const Cell& cell) const {
        if (!filter || cell.depth > 64) return false;
        Corner n;
        for (size_t i = 0; i < 3; ++i) {
            if (abs(normal[i]) > (std::int64_t(1) << 50)) return false;
            n[i] = double(std::int64_t(normal[i]));  // exact
        }
        // n . n is exact below 2^53, and so is s then: the test corrects the root. Else n . n errs by 5 u, and the root
        // by less than 8 u, which 1 + 2^-49 makes up for.
        const double square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
        double s = std::ceil(std::sqrt(square)), d = -std::numeric_limits<double>::infinity();
        if (square >= 0x1p53 || s * s < square) s = (s + 1) * (1 + 0x1p-49);
        for (uint32_t p : fixed_points) {
            const Corner& c = fixed.points[p];
            d = std::max(d, n[0] * c[0] + n[1] * c[1] + n[2] * c[2]);
        }
        d += s * rounded_reach;
        const double sum = std::abs(n[0]) * size[0] + std::abs(n[1]) * size[1] + std::abs(n[2]) * size[2] +
                           s * rounded_reach * size_of_w;
        const double error = (cell.depth + 8) * 0x1p-51 * sum;
        for (const auto& b : cell.rounded) {
            Corner row;
            for (size_t k = 0; k < 3; ++k) row[k] = n[0] * b[k] + n[1] * b[4 + k] + n[2] * b[8 + k];
            const double constant = n[0] * b[3] + n[1] * b[7] + n[2] * b[11] - d * b[W];
            for (uint32_t p : moving_points) {
                const Corner& c = moving.points[p];
                if (!(row[0] * c[0] + row[1] * c[1] + row[2] * c[2] + constant > error)) return false;
            }
        }
        return true;
    }

    // ---- Witness -------------------------------------------------------------------------------------------------

    // At the place of the witness, times W of that place.
    Vector point(const Body& body, size_t face, size_t k) const {
        const Vector c = in_units(body.corner(face, k), unit);
        if (&body == &fixed) return place[W] * c;
        const auto row = [&](size_t i) { return dot({place[i], place[i + 1], place[i + 2]}, c) + place[i + 3]; };
        return {row(0), row(4), row(8)};
    }

    size_t read_convex_face(const Body& body) {
        const size_t face = in.number(body.faces()), count = body.size(face);
        vector<Vector> c;
        for (size_t k = 0; k < count && count > 3; ++k) c.push_back(in_units(body.corner(face, k), unit));
        Vector normal;
        for (size_t k = 1; k + 1 < c.size(); ++k) normal = normal + cross(c[k] - c[0], c[k + 1] - c[0]);
        for (size_t k = 0; k < c.size(); ++k) {
            const Vector edge = c[(k + 1) % count] - c[k], next = c[(k + 2) % count] - c[(k + 1) % count];
            if (is_zero(normal) || dot(normal, cross(edge, next)) < 0 || dot(normal, cross(c[k] - c[0], edge)) < 0)
                fail("face " + to_string(face) + " of the " + body.name + " body is not convex");
        }
        return face;
    }

    std::pair<Vector, Integer> read_weighted_point(const Body& body) {  // the weighted sum, and the sum of the weights
        const size_t face = read_convex_face(body), count = body.size(face);
        const size_t i = in.number(count), j = in.number(count), k = in.number(count);
        if (i != 0 || j == 0 || k != j + 1) fail("the corners are not 0, k, k + 1");
        std::pair<Vector, Integer> p;
        for (size_t x : {i, j, k}) {
            const Integer weight = in.integer(in.word());
            if (weight < 0) fail("a negative weight");
            p = {p.first + weight * point(body, face, x), p.second + weight};
        }
        if (p.second == 0) fail("all weights are 0");
        return p;
    }

    void check_witness() {
        const string kind(in.word());
        if (kind != "cross" && kind != "near" && (kind != "inside" || verdict != "start"))
            fail("the witness " + quote(kind) + " is unknown or only for the start");
        if (kind == "inside") {
            uint32_t corner;
            if (read_winding(read_side(), corner) <= 0) fail("the corner is not inside of the other body");
            return;
        }
        const double tau = in.not_negative();
        if (verdict == "start" ? tau != 0 : tau < lower || tau > upper) fail("TAU is not where the verdict says");
        const Cubic<Integer> c = motion_of(poses[contact_piece], poses[contact_piece + 1], tau, unit);
        for (size_t k = 0; k < COLUMNS; ++k) place[k] = c[0][k] + c[1][k] + c[2][k] + c[3][k];
        if (kind == "near") {
            const auto [p, p_sum] = read_weighted_point(moving);
            const auto [q, q_sum] = read_weighted_point(fixed);
            const Vector difference = q_sum * p - p_sum * q;
            const Integer most = reach * place[W] * p_sum * q_sum;
            if (dot(difference, difference) > most * most) fail("the points are not near each other");
        } else {
            const Body &body = read_side(), &target = other(body);
            const size_t face = in.number(body.faces()), corner = in.number(body.size(face));
            const size_t triangle = read_convex_face(target), k = in.number(target.size(triangle) - 1);
            if (k == 0) fail("the corners are not 0, k, k + 1");
            check_cross(point(body, face, corner), point(body, face, (corner + 1) % body.size(face)),
                        {point(target, triangle, 0), point(target, triangle, k), point(target, triangle, k + 1)});
        }
    }

    static void check_cross(const Vector& p, const Vector& q, const std::array<Vector, 3>& t) {
        const Vector normal = cross(t[1] - t[0], t[2] - t[0]);
        if (is_zero(normal)) fail("the triangle has no area");
        const Integer a = dot(normal, p - t[0]), b = dot(normal, q - t[0]), weight = abs(a) + abs(b);
        if (weight == 0) fail("the edge is in the plane of the triangle");
        if (a.sign() * b.sign() > 0) fail("the edge is on one side of the triangle");
        const Vector meeting = abs(b) * p + abs(a) * q;  // times weight
        for (size_t i = 0; i < 3; ++i)
            if (dot(normal, cross(t[(i + 1) % 3] - t[i], meeting - weight * t[i])) < 0)
                fail("the edge meets the plane outside of the triangle");
    }

    template <class Numbers>
    static string text(const Numbers& numbers) {
        string line;
        std::array<char, 32> digits;
        for (double x : numbers) line += " " + string(&digits[0], std::to_chars(&digits[0], &digits[0] + 32, x).ptr);
        return line;
    }

    string claims() const {
        string lines = "verified: " + verdict;
        if (verdict == "contact") lines += " " + to_string(contact_piece) + text(std::array{lower, upper});
        lines += "\nmargin" + text(std::array{margin}) + "\nradius" + text(radii) + "\nsolid " + solid;
        for (const Pose* pose : {&poses.front(), &poses.back()})
            lines += (pose == &poses[0] ? "\nfirst pose" : "\nlast pose") + text(pose->position) + text(pose->q);
        return lines + "\npieces " + to_string(poses.size() - 1) + "\nsteps " + to_string(steps);
    }
};

// ---- Mesh files --------------------------------------------------------------------------------------------------

string lower_case(string text) {
    for (char& c : text) c = c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c;
    return text;
}

// a, a/b, a//c or a/b/c; a negative number counts back from the last corner so far. Returns a, from 0.
size_t obj_index(Word word, size_t count) {
    long long a = 0, ignored;
    const size_t slash = std::min(word.find('/'), word.size());
    bool good = parse(word.substr(0, slash), a) && a != 0 && a >= -static_cast<long long>(count);
    if (slash < word.size()) {
        const Word rest = word.substr(slash + 1);
        const size_t next = rest.find('/');
        good = good && (next == 0 || parse(rest.substr(0, next), ignored)) &&
               (next == Word::npos || parse(rest.substr(next + 1), ignored));
    }
    if (!good) fail("not a corner: " + quote(word));
    return a > 0 ? a - 1 : count + a;
}

Mesh read_obj(Reader& in) {
    vector<Corner> corners;
    vector<vector<size_t>> faces;
    while (in.next_line()) {
        Word word = in.optional_word();
        if (word == "v") corners.push_back(in.decimal_corner());
        if (word != "f") continue;
        faces.emplace_back();
        while (!(word = in.optional_word()).empty()) faces.back().push_back(obj_index(word, corners.size()));
        if (faces.back().size() < 3) fail("a face of less than three corners");
    }
    Mesh mesh(faces.size());
    for (size_t f = 0; f < faces.size(); ++f)
        for (size_t k : faces[f]) {
            if (k >= corners.size()) fail("face " + to_string(f) + ": no such corner");
            mesh[f].push_back(corners[k]);
        }
    return mesh;
}

Mesh read_text_stl(Reader& in) {
    static constexpr Word FACET[] = {"facet", "outer", "vertex", "vertex", "vertex", "endloop", "endfacet"};
    Mesh mesh;
    bool within = false;  // a solid
    size_t next = 0;      // line of a facet
    while (in.next_line()) {
        const string word = lower_case(string(in.optional_word()));
        if (word.empty()) continue;
        if (next == 0 && word == (within ? "endsolid" : "solid")) {
            within = !within;
            continue;
        }
        if (!within || word != FACET[next]) fail("unexpected word " + quote(word));
        if (next == 0) mesh.emplace_back();
        if (word == "vertex") mesh.back().push_back(in.decimal_corner()), in.end_of_line();
        next = (next + 1) % 7;
    }
    if (within) fail("the file ends within a solid");
    return mesh;
}

uint32_t little_endian(const string& data, size_t at) {
    uint32_t value = 0;
    for (size_t i = 4; i-- > 0;) value = value << 8 | uint8_t(data[at + i]);
    return value;
}

Mesh read_binary_stl(const string& data) {
    Mesh mesh(little_endian(data, 80), vector<Corner>(3));
    for (size_t f = 0; f < mesh.size(); ++f)
        for (size_t i = 0; i < 9; ++i)
            mesh[f][i / 3][i % 3] = std::bit_cast<float>(little_endian(data, 96 + 50 * f + 4 * i));
    return mesh;
}

}  // namespace

Mesh read_mesh(const string& path) {
    const string type = lower_case(std::filesystem::path(path).extension().string());
    if (type != ".obj" && type != ".stl") fail(path + ": neither OBJ nor STL by its name");
    std::error_code error;  // also of a folder
    const auto bytes = std::filesystem::file_size(path, error);
    if (error || bytes > LARGEST_FILE) fail(path + ": not a file, or too large");
    string data(bytes, '\0');
    if (!std::ifstream(path, std::ios::binary).read(data.data(), bytes)) fail(path + ": cannot be read");
    const bool binary = type == ".stl" && bytes >= 84 && bytes == 84 + 50 * uint64_t(little_endian(data, 80));
    std::istringstream stream(std::move(data));
    Reader reader{stream, type == ".obj"};
    try {
        Mesh mesh = binary ? read_binary_stl(stream.str()) : type == ".obj" ? read_obj(reader) : read_text_stl(reader);
        if (mesh.empty()) fail("no faces");
        return mesh;
    } catch (const std::runtime_error& reason) {
        fail(path + ": line " + to_string(reader.line) + ": " + reason.what());
    }
}

Verified verify(const Mesh& moving, const Mesh& fixed, std::istream& certificate) {
    Reader reader{certificate, false};
    try {
        return {true, Checker{reader}.check(moving, fixed)};
    } catch (const std::exception& reason) {  // std::bad_alloc too
        return {false, "not verified: line " + to_string(reader.line) + ": " + reason.what()};
    }
}

}  // namespace certificate

#ifndef CERTIFICATE_NO_MAIN
int main(int argc, char** argv) {
    std::error_code error;
    for (int i = 1; i < 4; ++i)
        if (argc != 4 || !std::filesystem::is_regular_file(argv[i], error) || !std::ifstream(argv[i])) {
            std::cerr << (argc != 4 ? "usage: verify MOVING FIXED CERTIFICATE" : "cannot read a file") << std::endl;
            return 2;
        }
    certificate::Verified result;
    try {
        const certificate::Mesh moving = certificate::read_mesh(argv[1]), fixed = certificate::read_mesh(argv[2]);
        std::ifstream file(argv[3], std::ios::binary);
        result = certificate::verify(moving, fixed, file);
    } catch (const std::exception& reason) {
        result.message = std::string("not verified: ") + reason.what();
    }
    std::cout << result.message << std::endl;
    return result.holds && std::cout ? 0 : 1;
}
#endif
