// Checks a certificate: a text file that proves whether bodies touch during a motion. What it claims and what each step
// needs to hold is said in the description of the format (certificate.md); the names here are those of that page.
//
//     g++ -std=c++20 -O2 verify.cpp -o verify && ./verify MESH [MESH ...] CERTIFICATE
//
// The meshes: MOVING FIXED, or those of a scene in any order, each once.
// Exit status: 0 verified, 1 not verified, 2 usage or a file that cannot be read.
//
// All decisions are made in integers. Lengths are integers in units of 2^unit, which divides all lengths of the input;
// denominators of the motion are cleared once for each piece. What is no fraction is enclosed: see Ball. Floating point
// only decides clear cases quickly, in the same formulas: see Ball too, and separates_clearly.

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
#include <map>
#include <numeric>
#include <optional>
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
using std::abs, std::size_t, std::string, std::uint32_t, std::uint64_t, std::uint8_t, std::vector, std::to_string;
using Word = std::string_view;
using Integer = mp::number<mp::cpp_int_backend<576>, mp::et_off>;  // of any size; up to 576 bits without allocation
template <class N> using Triple = std::array<N, 3>;
using Vector = Triple<Integer>;

constexpr size_t LONGEST_WORD = 1000, MOST_FACES = 1u << 30, MOST_PIECES = 1000000, MOST_LINKS = 1000;
constexpr size_t MOST_BODIES = 10000, MOST_PREPARED = 8192;  // the latter: cells times links
constexpr size_t LARGEST_FILE = size_t(1) << 34;
constexpr int DEEPEST_CELL = 4000;  // halvings

[[noreturn]] void fail(const string& what) { throw std::runtime_error(what); }

string quote(Word word) {
    string text(word.substr(0, 40));
    for (char& c : text) c = c >= ' ' && c <= '~' ? c : '?';
    return "'" + text + (word.size() > 40 ? "...'" : "'");
}

// ---- Numbers -----------------------------------------------------------------------------------------------------

std::pair<std::int64_t, int> dyadic(double x) {  // x = mantissa 2^exponent with an odd mantissa, or 0
    if (x == 0) return {0, 0};
    int exponent;
    const auto mantissa = std::int64_t(std::ldexp(std::frexp(x, &exponent), 53));
    const int zeros = std::countr_zero(uint64_t(mantissa));
    return {mantissa >> zeros, exponent - 53 + zeros};
}

constexpr int SMALLEST = -1100;  // 2^SMALLEST divides every double
struct Range {  // of exponents: 2^lowest divides all numbers, and 2^highest is above them
    int lowest = 0, highest = SMALLEST;
    void add(const Range& r) { lowest = std::min(lowest, r.lowest), highest = std::max(highest, r.highest); }
    template <class Numbers>
    void add(const Numbers& numbers) {
        for (double x : numbers)
            if (x != 0) lowest = std::min(lowest, dyadic(x).second), highest = std::max(highest, std::ilogb(x) + 1);
    }
};

Integer in_units(double x, int unit) {  // of 2^unit, which divides x
    const auto [mantissa, exponent] = dyadic(x);
    return mantissa == 0 ? Integer(0) : Integer(mantissa) << (exponent - unit);
}
Vector in_units(const Corner& c, int u) { return {in_units(c[0], u), in_units(c[1], u), in_units(c[2], u)}; }

template <class N> N dot(const Triple<N>& a, const Triple<N>& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
template <class N> Triple<N> cross(const Triple<N>& a, const Triple<N>& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class S, class N> Triple<N> operator*(const S& s, const Triple<N>& a) {
    return {s * a[0], s * a[1], s * a[2]};
}
template <class N> Triple<N> operator+(const Triple<N>& a, const Triple<N>& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class N> Triple<N> operator-(const Triple<N>& a) { return {-a[0], -a[1], -a[2]}; }
template <class N> Triple<N> operator-(const Triple<N>& a, const Triple<N>& b) { return a + -b; }
bool is_zero(const Vector& a) { return a == Vector{}; }

double truncated(const Integer& x, long exponent) {  // x 2^exponent, up to 2^-52 of it nearer to 0, if not subnormal
    if (x == 0) return 0;
    const Integer size = abs(x);
    const long cut = std::max(0L, long(msb(size)) - 52);
    const auto top = double(uint64_t(size >> cut));
    const double result = std::ldexp(top, int(std::clamp(cut + exponent, -9999L, 9999L)));
    return x < 0 ? -result : result;
}

// A number between middle - radius and middle + radius. With integers nothing is rounded, and an exact one has the
// radius 0. With doubles `outward` makes up for the roundings of the middle (2^-53 of it) and of the radius, and adds
// 2^-900 for underflow. After an overflow the radius is infinite or not a number, so that no sign is known.
const Integer& outward(const Integer& radius, const Integer&) { return radius; }
double outward(double radius, double middle) { return (radius + abs(middle) * 0x1p-52) * (1 + 0x1p-50) + 0x1p-900; }

template <class N>
struct Ball {
    N middle, radius;
    Ball(N m = 0, N r = 0) : middle(std::move(m)), radius(std::move(r)) {}
    bool not_negative() const { return middle >= radius; }
    int sign() const { return abs(middle) > radius ? (middle < 0 ? -1 : 1) : 0; }  // 0 also if it is not known
    N most() const { return abs(middle) + radius; }  // of the absolute value
    bool is_zero() const { return middle == 0 && radius == 0; }
    Ball operator-() const { return {-middle, radius}; }
    friend Ball operator+(const Ball& a, const Ball& b) {
        const N middle = a.middle + b.middle;
        return {middle, outward(a.radius + b.radius, middle)};
    }
    friend Ball operator-(const Ball& a, const Ball& b) { return a + -b; }
    friend Ball operator*(const Ball& a, const Ball& b) {
        if (a.is_zero() || b.is_zero()) return {};  // frequent in matrices
        const N middle = a.middle * b.middle;
        return {middle, outward(abs(a.middle) * b.radius + a.radius * b.most(), middle)};
    }
};
using Interval = Ball<Integer>;
using Enclosure = Triple<Interval>;
template <class N> Triple<Ball<N>> balls(const Triple<N>& v) { return {v[0], v[1], v[2]}; }

// Numbers without a unit (those of a rotation, angles, tau) are enclosed as multiples of 2^-BITS. In a chain 2^BITS
// units of length are more than the greatest length. Products are divided by ONE = 2^BITS. `up` is not less than the
// quotient; for doubles, which stay as they are, it makes up for the roundings of 4000 sums and products before.
constexpr int BITS = 256;
const Integer ONE = Integer(1) << BITS;
Integer up(const Integer& x) { return (x >> BITS) + 1; }
double up(double x) { return x * (1 + 0x1p-40) + 0x1p-900; }
Interval reduced(const Interval& x) { return x.is_zero() ? x : Interval{x.middle >> BITS, up(x.radius) + 1}; }
Enclosure reduced(const Enclosure& x) { return {reduced(x[0]), reduced(x[1]), reduced(x[2])}; }
const Triple<Ball<double>>& reduced(const Triple<Ball<double>>& x) { return x; }
bool absurd(const Integer& x) { return msb(x) > 20000; }                // takes too long
bool absurd(double) { return false; }
Integer root(const Integer& x) { return sqrt(x) + 1; }                   // not less than the square root
double root(double x) { return up(std::sqrt(x + 0x1p-1000)); }           // squares may underflow
template <class N> N length(const Triple<Ball<N>>& y) {                  // not less than |y|
    const Triple<N> most = {y[0].most(), y[1].most(), y[2].most()};
    return root(dot(most, most));
}
Interval quotient(const Interval& a, const Integer& b) { return {a.middle / b, a.radius / b + 2}; }  // b > 0
Enclosure quotient(const Vector& a, const Integer& b) {
    return {quotient(a[0], b), quotient(a[1], b), quotient(a[2], b)};
}
Ball<double> rounded(const Interval& x, int exponent) {  // times 2^exponent
    const double middle = truncated(x.middle, exponent);
    return {middle, outward(up(truncated(x.radius, exponent)) + abs(middle) * 0x1p-49, middle)};
}
Triple<Ball<double>> rounded(const Enclosure& x, int e) {
    return {rounded(x[0], e), rounded(x[1], e), rounded(x[2], e)};
}
Interval fixed_point(const Integer& mantissa, long exponent) {  // mantissa 2^exponent
    const long shift = exponent + BITS;
    return shift >= 0 ? Interval(mantissa << shift) : Interval(mantissa >> -shift, 1);
}
Interval fixed_point(double x) { return fixed_point(dyadic(x).first, dyadic(x).second); }

Enclosure unit_vector(const Vector& a) {  // the root of a whole number is rounded down
    Enclosure u;
    for (size_t i = 0; i < 3; ++i)
        if (a[i] != 0) u[i] = {a[i].sign() * sqrt(Integer((a[i] * a[i] << 2 * BITS) / dot(a, a))), 1};
    return u;
}

// Of a number in [0, 1]. Four times, atan x = 2 atan y with y = x / (1 + sqrt(1 + x^2)): the rounded root makes y too
// large by less than 1, rounding y makes it too small by less than 1. Then x < 0.1, and its powers divided by 1, 3, 5
// and so on have alternating signs: the rest of the sum is less than the next of them. The slope is at most 1.
Interval arc_tangent(const Interval& x, int halvings = 4) {
    Interval sum, power = x.middle;
    if (halvings > 0) {
        const Integer y = (x.middle << BITS) / (ONE + sqrt(Integer(ONE * ONE + x.middle * x.middle)));
        sum = Interval(2) * arc_tangent({y, 1}, halvings - 1);
    } else {
        const Interval square = reduced(power * power);
        for (int n = 1; power.middle != 0; n += 2, power = reduced(power * square))
            sum = n % 4 == 1 ? sum + quotient(power, n) : sum - quotient(power, n);
        sum.radius += power.radius;
    }
    return {sum.middle, sum.radius + x.radius};
}

// After whole quarter turns, the rest has an absolute value x < 1.6. The powers of x, divided by the factorials, are at
// least halved by each step from the third on: from one of them on, the sum is at most twice that one. The slopes are
// at most 1.
std::pair<Interval, Interval> cosine_and_sine(const Interval& angle) {
    static const Interval quarter = Interval(2) * arc_tangent(ONE);
    const Integer quarters = angle.middle / quarter.middle;
    const Interval rest = angle - quarters * quarter;
    if (rest.radius > ONE >> 100) fail("an angle is too large");
    Interval cosine, sine, term = ONE;
    for (int n = 0; term.middle != 0; ++n) {
        Interval& sum = n % 2 == 0 ? cosine : sine;
        sum = n % 4 < 2 ? sum + term : sum - term;
        term = quotient(reduced(term * abs(rest.middle)), n + 1);
    }
    for (Interval* sum : {&cosine, &sine}) sum->radius += 2 * term.radius + rest.radius;
    if (rest.middle < 0) sine = -sine;
    for (int n = int((quarters % 4 + 4) % 4); n > 0; --n) std::swap(cosine, sine), cosine = -cosine;
    return {cosine, sine};
}

// ---- SHA-256 (FIPS 180-4) ----------------------------------------------------------------------------------------

string sha256(string data) {
    std::array<uint32_t, 64> k, w{};
    std::array<uint32_t, 8> h, s;
    uint32_t p = 1, divisor;
    for (size_t n = 0; n < 64; ++n) {  // the constants are the fractional parts of roots of the first primes
        do
            for (divisor = 2, ++p; p % divisor != 0;) ++divisor;
        while (divisor < p);
        if (n < 8) h[n] = uint32_t(uint64_t(std::sqrt(p) * 0x1p32));
        k[n] = uint32_t(uint64_t(std::cbrt(p) * 0x1p32));
    }
    const uint64_t bits = 8 * data.size();
    data += '\x80';
    while (data.size() % 64 != 56) data += '\0';
    for (int i = 56; i >= 0; i -= 8) data += char(bits >> i);
    auto mix = [](uint32_t x, int a, int b, int c) { return std::rotr(x, a) ^ std::rotr(x, b) ^ std::rotr(x, c); };
    for (size_t at = 0; at < data.size(); at += 64) {
        s = h;
        for (size_t i = 0; i < 64; ++i) {
            for (size_t j = 0; i < 16 && j < 4; ++j) w[i] = w[i] << 8 | uint8_t(data[at + 4 * i + j]);
            if (i >= 16)
                w[i] = w[i - 16] + w[i - 7] + (std::rotr(w[i - 15], 7) ^ std::rotr(w[i - 15], 18) ^ w[i - 15] >> 3) +
                       (std::rotr(w[i - 2], 17) ^ std::rotr(w[i - 2], 19) ^ w[i - 2] >> 10);
            const uint32_t a = s[7] + mix(s[4], 6, 11, 25) + ((s[4] & s[5]) ^ (~s[4] & s[6])) + k[i] + w[i];
            const uint32_t b = mix(s[0], 2, 13, 22) + ((s[0] & s[1]) ^ (s[0] & s[2]) ^ (s[1] & s[2]));
            s = {a + b, s[0], s[1], s[2], s[3] + a, s[4], s[5], s[6]};
        }
        for (size_t i = 0; i < 8; ++i) h[i] += s[i];
    }
    string text;
    for (size_t i = 0; i < 64; ++i) text += "0123456789abcdef"[h[i / 8] >> (28 - i % 8 * 4) & 15];
    return text;
}

// ---- Words -------------------------------------------------------------------------------------------------------

template <class Number, class... Base>
bool parse(Word word, Number& x, Base... base) {  // the whole word; no sign +
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), x, base...);
    return error == std::errc() && end == word.data() + word.size();
}

struct Reader {
    std::istream& in;
    const bool joins;  // lines that end in a backslash
    const bool is_strict = false;  // a certificate: only tabs and printable ASCII
    string text{};     // of this line
    size_t at = 0, line = 0;

    bool next_line() {  // false at the end of the file
        at = 0, text.clear();
        if (!std::getline(in, text)) return false;
        for (string more;; text += more) {
            ++line;
            if (text.ends_with('\r')) text.pop_back();
            if (is_strict && std::any_of(text.begin(), text.end(), [](char c) { return c != '\t' && (c < ' ' || c > '~'); }))
                fail("a byte is neither a tab nor printable ASCII");
            if (!joins || !text.ends_with('\\')) break;
            text.back() = ' ';
            if (!std::getline(in, more)) break;
        }
        text.resize(std::min(text.find('#'), text.size()));
        return true;
    }
    bool blank() const { return text[at] == ' ' || (text[at] >= '\t' && text[at] <= '\r'); }
    bool more() {  // words in this line
        while (at < text.size() && blank()) ++at;
        return at < text.size();
    }
    Word optional_word() {  // the next word of this line; empty if there is none
        more();
        const size_t start = at;
        while (at < text.size() && !blank()) ++at;
        if (at - start > LONGEST_WORD) fail("a word is too long");
        return Word(text).substr(start, at - start);
    }
    Word word() {  // the next word of this line
        if (!more()) fail("a word is missing at the end of the line");
        return optional_word();
    }
    Word any_word() {  // the next word of this or a later line; empty at the end of the file
        while (!more() && next_line()) {}
        return optional_word();
    }
    Word peek() {  // any_word() that is not taken
        const Word next = any_word();
        at -= next.size();
        return next;
    }
    template <class Use>
    void next(Word keyword, const Use& read) {  // a line
        expect(keyword, any_word());
        read();
        end_of_line();
    }
    void expect(Word wanted, Word word) {
        if (word != wanted) fail(quote(wanted) + " expected instead of " + (word.empty() ? "the end" : quote(word)));
    }
    void end_of_line() {
        if (more()) fail("unexpected word " + quote(optional_word()));
    }
    size_t number(size_t limit, size_t least = 0) {  // below the limit
        size_t n;
        const Word digits = word();
        if (!parse(digits, n) || has_leading_zeros(digits)) fail("not a number: " + quote(digits));
        if (n < least || n >= limit) fail("the number " + quote(digits) + " is out of range");
        return n;
    }
    static bool has_leading_zeros(Word word) {
        return word != "0" && word.find_first_not_of('-') == word.find('0');
    }
    Integer integer(Word word) {
        std::int64_t small;
        if (has_leading_zeros(word)) fail("not an integer: " + quote(word));
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
        uint64_t mantissa;
        int exponent;
        if (!digits.starts_with("0x") || digits.find_first_of("ABCDEF") != string::npos ||
            !parse(Word(digits).substr(2), mantissa, 16) || !parse(rest.substr(p + 1 + plus), exponent) ||
            std::abs(long(exponent)) > 99999 || rest.size() - p - 1 - (rest.find_first_of("+-", p) == p + 1) > 5 || std::min(point, p) > 34 || p - point > 33)
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
    Corner decimal_corner() {
        Corner c;
        for (double& x : c) {
            const Word all = word();
            if (!parse(all.substr(all.starts_with('+') && !all.starts_with("+-")), x) || !std::isfinite(x))
                fail("not a finite decimal number: " + quote(all));
        }
        return c;
    }
};

// ---- Bodies ------------------------------------------------------------------------------------------------------

// A range of the order; all nodes are numbered in depth-first order.
struct Node { uint32_t begin, end, number; };

std::pair<Node, Node> halves(const Node& n) {
    const uint32_t middle = n.begin + (n.end - n.begin) / 2;  // = (begin + end) / 2 rounded down
    return {{n.begin, middle, n.number + 1}, {middle, n.end, n.number + 2 * (middle - n.begin)}};
}

template <class Item>
void make_unique(vector<Item>& items) {
    std::sort(items.begin(), items.end());
    items.erase(std::unique(items.begin(), items.end()), items.end());
    items.shrink_to_fit();
}

struct Link {  // as the file has it. The motion of a screw or a sweep is one link of that kind
    string kind{};
    bool back = false;
    vector<double> fixed{};    // numbers of its line; the centre of a sweep
    size_t size = 0;           // of its numbers at a knot
    vector<double> numbers{};  // at all knots
    bool operator==(const Link&) const = default;
    bool is_cubic() const { return kind == "screw" || kind == "sweep"; }
    bool between_poses() const { return size >= 7; }
    Vector vector_in_units(int unit) const { return in_units({fixed[0], fixed[1], fixed[2]}, unit); }
};

struct Body {
    string name;  // for messages: "moving ", "fixed ", or nothing
    string hash{};
    double radius = 0;
    bool solid = false;
    vector<Link> links{};
    Range lengths{};                         // of the points and the links
    vector<Corner> points{};                 // the different corners
    vector<uint32_t> corners{}, order{};     // corners of all faces, as numbers of points
    vector<size_t> first = {0};              // those of face f start at first[f]
    Corner largest = {0, 0, 0};              // absolute coordinates
    vector<vector<uint32_t>> node_points{};  // the different corners of each node, found when needed
    vector<uint32_t> part{};                 // for each point the point that stands for its connected part
    vector<bool> proven{};                   // for each part (its point) whether it is outside

    void read(const Mesh& mesh) {
        if (mesh.empty() || mesh.size() >= MOST_FACES) fail("the " + name + "body has no faces or too many");
        string data;  // to be hashed
        const auto add = [&](uint64_t value, int bytes) {  // little-endian
            for (int i = 0; i < bytes; ++i) data += char(value >> 8 * i);
        };
        for (const auto& face : mesh) {
            if (face.size() < 3) fail("a face of the " + name + "body has less than three corners");
            add(face.size(), 4);
            for (Corner c : face) {
                for (size_t i = 0; i < 3; ++i) {
                    if (!std::isfinite(c[i])) fail("a coordinate of the " + name + "body is not finite");
                    add(std::bit_cast<uint64_t>(c[i] += 0.0), 8);  // 0 for -0
                    largest[i] = std::max(largest[i], std::abs(c[i]));
                }
                points.push_back(c);
            }
            first.push_back(points.size());
        }
        hash = sha256(std::move(data));
        const vector<Corner> all = points;
        if (all.size() >= 4 * MOST_FACES - 1) fail("the " + name + "body has too many corners");
        make_unique(points);
        for (const Corner& c : points) lengths.add(c);
        for (const Corner& c : all)
            corners.push_back(uint32_t(std::lower_bound(points.begin(), points.end(), c) - points.begin()));
    }

    size_t faces() const { return first.size() - 1; }
    size_t size(size_t face) const { return first[face + 1] - first[face]; }
    uint32_t point(size_t face, size_t k) const { return corners[first[face] + k]; }

    // Every edge of a solid occurs once in each of the two directions, in two faces.
    void check_solid() const {
        if (!solid) return;
        vector<uint64_t> edges;
        for (size_t f = 0; f < faces(); ++f) {
            vector<uint32_t> c(corners.begin() + first[f], corners.begin() + first[f + 1]);
            for (size_t k = 0; k < c.size(); ++k) edges.push_back(uint64_t(c[k]) << 32 | c[(k + 1) % c.size()]);
            make_unique(c);
            if (c.size() < size(f)) fail("face " + to_string(f) + " of the solid " + name + "body has a corner twice");
        }
        std::sort(edges.begin(), edges.end());
        if (std::adjacent_find(edges.begin(), edges.end()) != edges.end())
            fail("two faces of the solid " + name + "body have an edge in the same direction");
        for (uint64_t edge : edges)
            if (!std::binary_search(edges.begin(), edges.end(), std::rotl(edge, 32)))
                fail("an edge of the solid " + name + "body has a face at one side only");
    }

    void find_parts() {  // none of which is proven
        proven.assign(points.size(), false);
        if (!part.empty()) return;
        part.resize(points.size());
        std::iota(part.begin(), part.end(), 0u);
        const auto root = [&](uint32_t p) {
            while (part[p] != p) p = part[p] = part[part[p]];
            return p;
        };
        for (size_t f = 0; f < faces(); ++f)
            for (size_t k = first[f]; k < first[f + 1]; ++k) part[root(corners[k])] = root(corners[first[f]]);
        for (uint32_t& p : part) p = root(p);
    }

    const vector<uint32_t>& points_of(const Node& node) {
        auto& list = node_points[node.number];
        if (!list.empty()) return list;
        for (size_t i = node.begin; i < node.end; ++i)
            list.insert(list.end(), corners.begin() + first[order[i]], corners.begin() + first[order[i] + 1]);
        make_unique(list);
        return list;
    }
};

// ---- Motion ------------------------------------------------------------------------------------------------------

struct Quaternion {
    Integer w;
    Vector v;
    Integer norm() const { return w * w + dot(v, v); }
    Quaternion conjugate() const { return {-w, v}; }  // or its negative: the same rotation
    Quaternion operator*(const Quaternion& q) const {
        return {w * q.w - dot(v, q.v), w * q.v + q.w * v + cross(v, q.v)};
    }
    Vector rotate(const Vector& y) const {  // q y q^-1, times norm()
        return (w * w - dot(v, v)) * y + 2 * dot(v, y) * v + 2 * w * cross(v, y);
    }
};

struct Pose {
    Vector position;  // times `scale`
    Integer scale;
    Quaternion q;     // of any length

    // Of seven numbers, or of fourteen: that of the first pose as seen from the second one.
    Pose(const double* x, bool fourteen, int unit) : position(in_units({x[0], x[1], x[2]}, unit)), scale(1) {
        Range exponents;
        exponents.add(std::array{x[3], x[4], x[5], x[6]});
        const int u = exponents.lowest;  // times a power of two, which changes nothing
        q = {in_units(x[3], u), in_units(Corner{x[4], x[5], x[6]}, u)};
        if (!fourteen) return;
        const Pose frame(x + 7, false, unit);
        const Quaternion back = frame.q.conjugate();
        position = back.rotate(position - frame.position), scale = frame.q.norm(), q = back * q;
    }
};

Pose pose_at(const Link& link, size_t knot, int unit) {
    return {&link.numbers[knot * link.size], link.size == 14, unit};
}

Quaternion turn(const Quaternion& q0, const Quaternion& q1) {  // q1 q0^-1 or its negative, times |q0| |q0|
    const Quaternion q = q1 * q0.conjugate();
    if (q.w == 0) fail("a piece is half a turn");
    return q.w < 0 ? Quaternion{-q.w, -q.v} : q;
}

// The numbers that make W p and W of a corner b: coordinate i of W p is the sum of [4 i + k] b_k over k = 0, 1, 2, and
// [4 i + 3]; W is [12].
constexpr size_t COLUMNS = 13, W = 12;
template <class N> using Row = std::array<N, COLUMNS>;
template <class N> using Cubic = vector<Row<Ball<N>>>;  // coefficients of powers, or of Bernstein polynomials

// W p and W of a screw or sweep in powers of tau, times a common factor. For both kinds
//   W = W0 + tau W1 + tau^2 W2,  e = e0 + tau e1,  turned(y) = W y + 2 tau e (v x y) + 2 tau^2 v x (v x y),
//   W p = turned(R0 b - from) + W (start + tau way) + tau e0 m + tau^2 v x m,
// where for a screw W and e are multiplied by w w and w, `from` is 0, and m = w across - v x across; for a sweep `from`
// is R0 C, and m is 0.
Cubic<Integer> cubic_of(const Link& link, size_t piece, int unit) {
    const Pose pose0 = pose_at(link, piece, unit), pose1 = pose_at(link, piece + 1, unit);
    const bool sweep = link.kind == "sweep";
    auto [w, v] = turn(pose0.q, pose1.q);
    if (sweep) w <<= BITS, v = ONE * v;  // makes N a large number
    const Integer vv = dot(v, v), norm = pose0.q.norm(), scale = pose0.scale * pose1.scale;
    const Vector t0 = pose1.scale * pose0.position, q = pose0.scale * pose1.position - t0;  // times the scale
    Integer factor;                // this and the next line: times the scale and more; R0 is multiplied by factor norm
    Vector from{}, start, way, m{};
    Interval w0, w1, w2, e0, e1;
    if (sweep) {
        const Integer norm1 = pose1.q.norm(), nn = w * w + vv;
        const Interval n = {sqrt(nn), 1};
        const Vector centre = link.vector_in_units(unit);
        factor = scale * norm1, from = factor * pose0.q.rotate(centre), start = norm * norm1 * t0 + from;
        way = norm * norm1 * q + scale * norm * pose1.q.rotate(centre) - from;
        w0 = nn, w2 = Interval(2) * (nn - w * n), w1 = -w2, e0 = n, e1 = w - n;
    } else {
        const Integer divisor = vv == 0 ? Integer(1) : vv;
        const Vector along = vv == 0 ? q : dot(v, q) * v, across = divisor * q - along;  // times the divisor
        factor = scale * divisor, start = norm * divisor * t0, way = norm * along;
        m = norm * (w * across - cross(v, across));
        w0 = w * w, w2 = vv, e0 = w;
    }
    Cubic<Integer> c(4);
    for (size_t k = 0; k < 12; ++k) {
        const size_t i = k / 4, column = k % 4;
        const Vector axis = {column == 0, column == 1, column == 2};
        const Vector y = column < 3 ? factor * pose0.q.rotate(axis) : -from, vy = cross(v, y), vvy = cross(v, vy);
        c[0][k] = w0 * y[i];
        c[1][k] = w1 * y[i] + 2 * vy[i] * e0;
        c[2][k] = w2 * y[i] + 2 * vy[i] * e1 + 2 * vvy[i];
        if (column < 3) continue;
        c[0][k] = c[0][k] + w0 * start[i];
        c[1][k] = c[1][k] + w0 * way[i] + w1 * start[i] + e0 * m[i];
        c[2][k] = c[2][k] + w1 * way[i] + w2 * start[i] + cross(v, m)[i];
        c[3][k] = w2 * way[i];
    }
    c[0][W] = norm * factor * w0, c[1][W] = norm * factor * w1, c[2][W] = norm * factor * w2;
    return c;
}

struct Cell {  // of the time from 0 to `end`: [index, index + 1] / 2^depth of it
    double end;
    int depth = 0;
    Integer index = 0;
};

// Bernstein coefficients on the cell, times a power of two. There tau = (i + m x) / s with x in [0, 1].
Cubic<Integer> bernstein(const Cubic<Integer>& c, const Cell& cell) {
    const auto [mantissa, exponent] = dyadic(cell.end);  // at most 1, so that the exponent is at most 0
    const Integer m = mantissa, i = m * cell.index, s = Integer(1) << (cell.depth - exponent);
    Cubic<Integer> b(4);
    for (size_t k = 0; k < COLUMNS; ++k) {  // of a0 + a1 x + a2 x^2 + a3 x^3, times three
        const Interval a0 = 3 * s * s * s * c[0][k] + 3 * i * s * s * c[1][k] + 3 * i * i * s * c[2][k] +
                            3 * i * i * i * c[3][k];
        const Interval a1 = m * s * s * c[1][k] + 2 * m * i * s * c[2][k] + 3 * m * i * i * c[3][k];
        const Interval a2 = m * m * s * c[2][k] + 3 * m * m * i * c[3][k], a3 = m * m * m * c[3][k];
        b[0][k] = a0, b[1][k] = a0 + a1, b[2][k] = b[1][k] + a1 + a2, b[3][k] = a0 + Interval(3) * (a1 + a2 + a3);
    }
    return b;
}

Cubic<double> rounded(const Cubic<Integer>& cubic, int unit) {  // times a power of two
    Cubic<double> result(cubic.size());
    for (size_t j = 0; j < cubic.size(); ++j)
        for (size_t k = 0; k < COLUMNS; ++k)  // [3], [7] and [11] are lengths
            result[j][k] = rounded(cubic[j][k], (k % 4 == 3 ? unit : 0) - int(msb(cubic[0][W].middle)));
    return result;
}

// ---- Chains ------------------------------------------------------------------------------------------------------

using Matrix = Triple<Enclosure>;  // its columns
Enclosure operator*(const Matrix& m, const Enclosure& x) { return reduced(x[0] * m[0] + x[1] * m[1] + x[2] * m[2]); }
Matrix operator*(const Matrix& a, const Matrix& b) { return {a * b[0], a * b[1], a * b[2]}; }
Matrix transposed(const Matrix& m) {
    Matrix t;
    for (size_t i = 0; i < 9; ++i) t[i / 3][i % 3] = m[i % 3][i / 3];
    return t;
}
Matrix identity() {
    const Interval zero;
    return {Enclosure{ONE, zero, zero}, Enclosure{zero, ONE, zero}, Enclosure{zero, zero, ONE}};
}

// The motion of one body as seen from another one: what carries both is left out.
vector<Link> seen_from(const vector<Link>& other, const vector<Link>& own) {
    const auto [theirs, ours] = std::mismatch(other.begin(), other.end(), own.begin(), own.end());
    vector<Link> links(theirs, other.end());
    std::reverse(links.begin(), links.end());
    for (Link& link : links) link.back = !link.back;
    links.insert(links.end(), ours, own.end());
    if (links.empty()) links.push_back({.kind = "pose", .fixed = {0, 0, 0, 1, 0, 0, 0}});
    return links;
}

struct LinkMotion {  // of a piece; named as on the page
    bool back = false, turns = false, rotated = false;  // rotated: R is not 1
    Enclosure a0{}, v{}, b{}, axis{};  // axis: k
    Interval theta0{}, omega{};
    Matrix r = identity();

    LinkMotion(const Link& link, size_t piece, int unit) : back(link.back) {
        const auto set_rotation = [&](const Quaternion& q) {
            rotated = true;
            for (size_t k = 0; k < 3; ++k) r[k] = quotient(ONE * q.rotate({k == 0, k == 1, k == 2}), q.norm());
        };
        if (link.kind == "pose") {
            const Pose pose(&link.fixed[0], false, unit);
            a0 = balls(pose.position), set_rotation(pose.q);
        } else if (link.kind == "turn") {
            turns = true, axis = unit_vector(link.vector_in_units(SMALLEST));
            theta0 = fixed_point(link.numbers[piece]), omega = fixed_point(link.numbers[piece + 1]) - theta0;
        } else if (link.kind == "slide") {
            const Integer s0 = in_units(link.numbers[piece], unit), s1 = in_units(link.numbers[piece + 1], unit);
            const Enclosure way = {fixed_point(link.fixed[0]), fixed_point(link.fixed[1]), fixed_point(link.fixed[2])};
            a0 = reduced(s0 * way), v = reduced((s1 - s0) * way);
        } else {
            const Pose p0 = pose_at(link, piece, unit), p1 = pose_at(link, piece + 1, unit);
            const Quaternion q = turn(p0.q, p1.q);
            const Integer vv = dot(q.v, q.v);
            const Vector way = p1.position - p0.position;
            v = balls(way), set_rotation(p0.q);
            if (vv != 0) {
                // The angle is 4 atan (|v| / (N + w)). Both roots, of numbers times ONE^2, are rounded down.
                const Integer length = sqrt(Integer(vv << 2 * BITS)), n = sqrt(Integer(q.norm() << 2 * BITS));
                turns = true, axis = unit_vector(q.v);
                omega = Interval(4) * arc_tangent({(length << BITS) / (n + (q.w << BITS)), 2});
            }
            Enclosure c{};  // of a twist as on the page, of a velocity R0 C
            if (link.kind == "velocity") {
                const Vector centre = link.vector_in_units(unit);
                c = quotient(p0.q.rotate(centre), p0.q.norm());
                v = v + quotient(p1.q.rotate(centre), p1.q.norm()) - c;
            } else if (vv != 0) {
                const Vector along = dot(q.v, way) * q.v, across = vv * way - along;  // times vv
                c = quotient(vv * across + q.w * cross(q.v, across), 2 * vv * vv);
                v = quotient(along, vv);
            }
            a0 = balls(p0.position) + c, b = -c;
        }
    }

    Matrix rotation(const Interval& tau) const {  // S
        if (!turns) return identity();
        const auto [cosine, sine] = cosine_and_sine(theta0 + reduced(tau * omega));
        Matrix s = identity();
        for (Enclosure& e : s)
            e = reduced(cosine * e + sine * reduced(cross(axis, e)) +
                        reduced((ONE - cosine) * reduced(dot(axis, e))) * axis);
        return s;
    }
};

// Images of the three unit vectors without that of 0, and that of 0.
template <class N> using Affine = std::array<Triple<Ball<N>>, 4>;

template <class N> Triple<Ball<N>> image(const Affine<N>& f, const Triple<N>& b) {
    return reduced(b[0] * f[0] + b[1] * f[1] + b[2] * f[2]) + f[3];
}

template <class N>
struct Stage {  // y and y' of a link that turns, or after the last link x and x', as functions of b
    Affine<N> place{}, rate{};
    N omega = 0;  // not less than |omega|
};

vector<Stage<Integer>> stages_of(const vector<LinkMotion>& links, const Interval& tau) {
    vector<Stage<Integer>> stages;
    const Matrix one = identity();
    Affine<Integer> x = {one[0], one[1], one[2], Enclosure{}}, rate{};
    for (size_t i = links.size(); i-- > 0;) {
        const LinkMotion& link = links[i];
        const Enclosure a = link.a0 + reduced(tau * link.v);
        const Matrix s = link.rotation(tau), inverse = transposed(link.r);
        const Matrix after = link.back ? inverse * transposed(s) : s;
        const Interval omega = link.back ? -link.omega : link.omega;
        Stage<Integer> stage{{}, {}, omega.most()};
        for (size_t k = 0; k < 4; ++k) {
            Enclosure &y = stage.place[k] = x[k], &y_rate = stage.rate[k] = rate[k];
            if (!link.back && link.rotated) y = link.r * y, y_rate = link.r * y_rate;
            if (k == 3) y = link.back ? y - a : y + link.b;
            if (k == 3 && link.back) y_rate = y_rate - link.v;
            x[k] = y, rate[k] = link.turns ? y_rate + reduced(omega * reduced(cross(link.axis, y))) : y_rate;
            if (link.turns || (link.back && link.rotated)) x[k] = after * x[k], rate[k] = after * rate[k];
            if (k == 3) x[k] = link.back ? x[k] - inverse * link.b : x[k] + a;
            if (k == 3 && !link.back) rate[k] = rate[k] + link.v;
        }
        if (link.turns) stages.push_back(std::move(stage));
    }
    stages.push_back({x, rate, 0});
    return stages;
}

// ---- The certificate ---------------------------------------------------------------------------------------------

struct Motion {  // of a piece: of a screw or sweep the cubic, of a chain the links
    Cubic<Integer> cubic{};
    vector<LinkMotion> links{};
};

template <class N>
struct Plane {
    Triple<Ball<N>> n;
    N s;
    Ball<N> d{};  // d + s D of the page
};

struct Verdict {  // nothing touches up to `lower` of `piece`; if it is clear, that is the end of the last piece
    string kind{};
    size_t pieces = 0, piece = 0, i = 0, j = 1;  // i and j: the bodies that touch
    double lower = 0, upper = 0;
};

struct Pair {
    Reader& in;
    const Verdict& verdict;
    Body &moving, &fixed;
    vector<Link> links;
    bool chain;
    size_t steps = 0;
    int unit;                                // of lengths, as a power of two
    Integer reach;                           // D
    Row<Interval> place;                     // of the moving body for the outside lines and the witness
    struct Prepared {                        // what all planes of a cell need
        Cubic<Integer> cubic{};
        Cubic<double> rounded_cubic{};
        Integer h = 0;                       // this and the following: of a chain
        vector<Stage<Integer>> stages{};
        vector<Stage<double>> rounded_stages{};
    };
    std::map<std::pair<int, Integer>, Prepared> prepared{};  // of some cells of a piece: other nodes come to them again

    Pair(Reader& reader, const Verdict& v, Body& body_i, Body& body_j, double margin)
        : in(reader), verdict(v), moving(body_i), fixed(body_j), links(seen_from(fixed.links, moving.links)),
          chain(!links[0].is_cubic()) {
        Range lengths = moving.lengths;
        lengths.add(fixed.lengths), lengths.add(std::array{margin, moving.radius, fixed.radius});
        unit = chain ? std::min(lengths.lowest, lengths.highest - BITS) : lengths.lowest;
        reach = in_units(moving.radius, unit) + in_units(fixed.radius, unit) + in_units(margin, unit);
        place = place_at(0, 0);
    }

    void check_proofs() {
        check_outside();
        for (size_t piece = 0; piece <= verdict.piece; ++piece) {
            in.next("proof", [&] {
                if (in.number(verdict.pieces) != piece) fail("the proof of piece " + to_string(piece) + " is missing");
            });
            check_proof(piece, piece == verdict.piece ? verdict.lower : 1);
            in.end_of_line();
        }
    }

    Body& read_side() {
        const Word word = in.word();
        if (word != "moving" && word != "fixed") fail("unknown body " + quote(word));
        return word == "moving" ? moving : fixed;
    }
    const Body& other(const Body& body) const { return &body == &moving ? fixed : moving; }
    string side(const Body& body) const { return &body == &moving ? "moving" : "fixed"; }

    Motion motion_of(size_t piece) const {
        if (!chain) return {cubic_of(links[0], piece, unit)};
        Motion motion;
        for (const Link& link : links) motion.links.emplace_back(link, piece, unit);
        return motion;
    }

    Row<Interval> place_at(size_t piece, double tau) const {  // the numbers that make W p and W
        const Motion motion = motion_of(piece);
        if (!chain) return bernstein(motion.cubic, {tau}).back();
        const Affine<Integer> x = stages_of(motion.links, fixed_point(tau)).back().place;
        Row<Interval> row;
        for (size_t i = 0; i < 12; ++i) row[i] = i % 4 == 3 ? ONE * x[3][i / 4] : x[i % 4][i / 4];
        row[W] = ONE;
        return row;
    }

    // ---- Inside and outside --------------------------------------------------------------------------------------

    template <class N>
    static Triple<Ball<N>> rotated(const Row<Ball<N>>& at, const Triple<Ball<N>>& x) {  // times W
        return {dot({at[0], at[1], at[2]}, x), dot({at[4], at[5], at[6]}, x), dot({at[8], at[9], at[10]}, x)};
    }

    template <class N>
    Triple<Ball<N>> placed(const Row<Ball<N>>& at, const Body& body, uint32_t point) const {  // a corner, times W
        const Triple<Ball<N>> c = balls(corner<N>(body, point));
        return &body == &fixed ? at[W] * c : rotated(at, c) + Triple<Ball<N>>{at[3], at[7], at[11]};
    }

    Enclosure placed(const Body& body, size_t face, size_t k) const { return placed(place, body, body.point(face, k)); }

    // Reads F C X Y Z and counts how often the other body, a solid, winds around this corner at the start.
    long read_winding(const Body& body, uint32_t& point) {
        const Body& target = other(body);
        if (!target.solid) fail("the other body is not solid");
        const size_t face = in.number(body.faces());
        point = body.point(face, in.number(body.size(face)));
        Vector direction;
        for (Integer& x : direction) x = in.integer(in.word());
        if (is_zero(direction)) fail("a direction that is 0");
        // From the frame of the other body into that of the fixed one, times W.
        const Enclosure ray = &target == &fixed ? place[W] * balls(direction) : rotated(place, balls(direction));
        // In floating point, all for each point of the other body: from the corner to it, and ray x this.
        const Row<Ball<double>> rounded_place = rounded(Cubic<Integer>{place}, unit)[0];
        const Triple<Ball<double>> o = placed(rounded_place, body, point);
        const Triple<Ball<double>> rounded_ray = rounded(ray, -int(msb(place[W].middle)));
        vector<Triple<Ball<double>>> seen, turned;
        for (uint32_t p = 0; p < target.points.size(); ++p) {
            seen.push_back(placed(rounded_place, target, p) - o);
            turned.push_back(cross(rounded_ray, seen[p]));
        }
        const Enclosure origin = placed(place, body, point);
        long count = 0;
        for (size_t f = 0; f < target.faces(); ++f)
            for (size_t k = 1; k + 1 < target.size(f); ++k) {
                const Triple<uint32_t> t = {target.point(f, 0), target.point(f, k), target.point(f, k + 1)};
                const auto [above, below] = sides<double>({turned[t[0]], turned[t[1]], turned[t[2]]},
                                                          {seen[t[0]], seen[t[1]], seen[t[2]]});
                if (above > 0 && below > 0) continue;
                const auto p = [&](size_t i) { return placed(place, target, t[i]) - origin; };
                count += crossing({p(0), p(1), p(2)}, ray, f);
            }
        return count;
    }

    // The line of a ray from 0 goes through the inside of a triangle p if the products (direction x p_i) . p_i+1 have
    // the same sign, and misses it if two of them have different signs.
    template <class N>
    static std::pair<int, int> sides(const Triple<Triple<Ball<N>>>& turned, const Triple<Triple<Ball<N>>>& p) {
        int above = 0, below = 0;
        for (size_t i = 0; i < 3; ++i) {
            const int sign = dot(turned[i], p[(i + 1) % 3]).sign();
            above += sign > 0, below += sign < 0;
        }
        return {above, below};
    }

    static int crossing(const Triple<Enclosure>& p, const Enclosure& direction, size_t face) {
        const auto [above, below] =
            sides<Integer>({cross(direction, p[0]), cross(direction, p[1]), cross(direction, p[2])}, p);
        if (above > 0 && below > 0) return 0;
        const string where = " face " + to_string(face) + " of the other body and proves nothing";
        if (above + below == 0) fail("the ray is in the plane of" + where);
        // If the line meets the triangle, it is at the distance height / slope; the slope has the sign of the products.
        const int height = dot(cross(p[1] - p[0], p[2] - p[0]), p[0]).sign();
        if (height == 0) fail("the corner is on" + where);
        if ((height > 0) != (above > 0)) return 0;  // behind the corner
        if (above + below < 3) fail("the ray meets an edge of" + where);
        return above > 0 ? 1 : -1;
    }

    void check_outside() {
        for (Body* body : {&moving, &fixed})
            if (other(*body).solid) body->find_parts();
        while (in.peek() == "outside")
            in.next("outside", [&] {
                Body& body = read_side();
                uint32_t point;
                if (read_winding(body, point) > 0) fail("the corner is inside of the other body");
                body.proven[body.part[point]] = true;
            });
        for (const Body* body : {&moving, &fixed})
            for (uint32_t p : body->part)
                if (other(*body).solid && !body->proven[p])
                    fail("a part of the " + side(*body) + " body has no line 'outside'");
    }

    // ---- Proof ---------------------------------------------------------------------------------------------------

    void check_proof(size_t piece, double end) {
        struct Task { Node moving, fixed; size_t cell; };  // the cell is never behind that of a later task
        const Motion motion = motion_of(piece);
        vector<Cell> cells = {{end}};
        prepared.clear();
        vector<Task> tasks = {{{0, uint32_t(moving.faces()), 0}, {0, uint32_t(fixed.faces()), 0}, 0}};
        for (size_t step = 1; !tasks.empty(); ++step, ++steps) {
            const auto [a, b, number] = tasks.back();
            tasks.pop_back();
            cells.erase(cells.begin() + long(number) + 1, cells.end());
            const Cell& cell = cells[number];
            const auto refuse = [&, step = step](const string& what) {
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
                const int depth = cell.depth + 1;
                const Integer low = 2 * cell.index;
                cells.push_back({end, depth, low + 1}), cells.push_back({end, depth, low});
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

    template <class N>
    Triple<N> corner(const Body& body, uint32_t point) const {
        if constexpr (std::is_same_v<N, double>) return body.points[point];
        else return in_units(body.points[point], unit);
    }

    bool separates(const Vector& n, const vector<uint32_t>& moving_points, const vector<uint32_t>& fixed_points,
                   const Cell& cell, const Motion& motion) {
        const Prepared& at = prepare(cell, motion);
        if (separates_clearly(n, moving_points, fixed_points, at)) return true;
        const Integer square = dot(n, n);
        Integer s = sqrt(square);
        if (s * s < square) ++s;
        const Plane<Integer> plane = {balls(n), s, farthest(n, fixed_points) + s * reach};
        return chain ? chain_separates(at.stages, at.h, plane, moving_points)
                     : cubic_separates(at.cubic, plane, moving_points);
    }

    // In floating point. n . n is exact below 2^53, and so is s then: the test corrects the root. Else n . n errs by
    // 5 u, u = 2^-53, and the root by less than 8 u, which 1 + 2^-49 makes up for. d + s D errs by less than 8 u of the
    // sum of the absolute values of its terms (if that overflows, nothing is separated).
    bool separates_clearly(const Vector& normal, const vector<uint32_t>& moving_points,
                           const vector<uint32_t>& fixed_points, const Prepared& at) const {
        Corner n;
        for (size_t i = 0; i < 3; ++i) {
            if (abs(normal[i]) > (std::int64_t(1) << 50)) return false;
            n[i] = double(std::int64_t(normal[i]));  // exact
        }
        const double square = dot(n, n), distance = truncated(reach, unit);
        double s = std::ceil(std::sqrt(square));
        if (square >= 0x1p53 || s * s < square) s = (s + 1) * (1 + 0x1p-49);
        const double terms = dot({abs(n[0]), abs(n[1]), abs(n[2])}, fixed.largest) + s * distance;
        const Plane<double> plane = {balls(n), s, {farthest(n, fixed_points) + s * distance, up(terms * 0x1p-50)}};
        return chain ? chain_separates(at.rounded_stages, up(truncated(at.h, -BITS)), plane, moving_points)
                     : cubic_separates(at.rounded_cubic, plane, moving_points);
    }

    template <class N>
    N farthest(const Triple<N>& n, const vector<uint32_t>& fixed_points) const {  // d of the page
        N d = dot(n, corner<N>(fixed, fixed_points[0]));
        for (uint32_t p : fixed_points) d = std::max(d, dot(n, corner<N>(fixed, p)));
        return d;
    }

    template <class N>
    bool cubic_separates(const Cubic<N>& c, const Plane<N>& plane, const vector<uint32_t>& moving_points) const {
        for (const Row<Ball<N>>& b : c) {
            Triple<Ball<N>> row;
            for (size_t k = 0; k < 3; ++k) row[k] = dot(plane.n, {b[k], b[4 + k], b[8 + k]});
            const Ball<N> constant = dot(plane.n, {b[3], b[7], b[11]}) - plane.d * b[W];
            for (uint32_t p : moving_points)
                if ((dot(row, balls(corner<N>(moving, p))) + constant).sign() <= 0) return false;
        }
        return true;
    }

    template <class N>
    bool chain_separates(const vector<Stage<N>>& all, const N& half, const Plane<N>& plane,
                         const vector<uint32_t>& moving_points) const {
        for (uint32_t p : moving_points) {
            const Triple<N> b = corner<N>(moving, p);
            N g = 0;
            for (const Stage<N>& stage : all) {
                const Triple<Ball<N>> y = image(stage.place, b), rate = image(stage.rate, b);
                if (&stage == &all.back()) {  // n . x - h |n . x'| - s g h^2 / 2 > d + s D, times two
                    const Ball<N> x = dot(plane.n, y) - plane.d,
                        rest = {0, 2 * up(half * dot(plane.n, rate).most()) + plane.s * up(half * up(half * g))};
                    if ((x + x + rest).sign() <= 0) return false;
                } else {
                    const N f = length(rate) + up(half * g), r = length(y) + up(half * f);
                    g += up(stage.omega * (2 * f + up(stage.omega * r)));
                    if (absurd(g)) return false;
                }
            }
        }
        return true;
    }

    const Prepared& prepare(const Cell& cell, const Motion& motion) {
        if (prepared.size() * links.size() > MOST_PREPARED) prepared.clear();
        const auto [known, is_new] = prepared.try_emplace({cell.depth, cell.index});
        Prepared& at = known->second;
        if (is_new && !chain) at.cubic = bernstein(motion.cubic, cell), at.rounded_cubic = rounded(at.cubic, unit);
        if (!is_new || !chain) return at;
        const auto [mantissa, exponent] = dyadic(cell.end);
        const int power = exponent - cell.depth - 1;
        at.h = fixed_point(mantissa, power).most();
        at.stages = stages_of(motion.links, fixed_point(mantissa * (2 * cell.index + 1), power));
        for (const Stage<Integer>& stage : at.stages) {
            Stage<double>& r = at.rounded_stages.emplace_back();
            r.omega = up(truncated(stage.omega, -BITS));
            for (size_t k = 0; k < 4; ++k) {  // the last one is a length
                r.place[k] = rounded(stage.place[k], k == 3 ? unit : -BITS);
                r.rate[k] = rounded(stage.rate[k], k == 3 ? unit : -BITS);
            }
        }
        return at;
    }

    // ---- Witness -------------------------------------------------------------------------------------------------

    size_t read_convex_face(const Body& body) {
        const size_t face = in.number(body.faces()), count = body.size(face);
        vector<Vector> c;
        for (size_t k = 0; k < count && count > 3; ++k) c.push_back(corner<Integer>(body, body.point(face, k)));
        Vector normal;
        for (size_t k = 1; k + 1 < c.size(); ++k) normal = normal + cross(c[k] - c[0], c[k + 1] - c[0]);
        for (size_t k = 0; k < c.size(); ++k) {
            const Vector edge = c[(k + 1) % count] - c[k], next = c[(k + 2) % count] - c[(k + 1) % count];
            if (is_zero(normal) || dot(normal, cross(edge, next)) < 0 || dot(normal, cross(c[k] - c[0], edge)) < 0)
                fail("face " + to_string(face) + " of the " + side(body) + " body is not convex");
        }
        return face;
    }

    std::pair<Enclosure, Integer> read_weighted_point(const Body& body) {  // the weighted sum, the sum of the weights
        const size_t face = read_convex_face(body), count = body.size(face);
        const size_t i = in.number(count), j = in.number(count), k = in.number(count);
        if (i != 0 || j == 0 || k != j + 1) fail("the corners are not 0, k, k + 1");
        std::pair<Enclosure, Integer> p;
        for (size_t x : {i, j, k}) {
            const Integer weight = in.integer(in.word());
            if (weight < 0) fail("a negative weight");
            p = {p.first + weight * placed(body, face, x), p.second + weight};
        }
        if (p.second == 0) fail("all weights are 0");
        return p;
    }

    void check_witness() {
        const string type(in.word());
        if (type != "cross" && type != "near" && (type != "inside" || verdict.kind != "start"))
            fail("the witness " + quote(type) + " is unknown or only for the start");
        if (type == "inside") {
            uint32_t corner;
            if (read_winding(read_side(), corner) <= 0) fail("the corner is not inside of the other body");
            return;
        }
        const double tau = in.not_negative();
        if (tau < verdict.lower || tau > verdict.upper) fail("TAU is not where the verdict says");
        place = place_at(verdict.piece, tau);
        if (type == "near") {
            const auto [p, p_sum] = read_weighted_point(moving);
            const auto [q, q_sum] = read_weighted_point(fixed);
            const Enclosure difference = q_sum * p - p_sum * q;
            const Interval most = reach * p_sum * q_sum * place[W];
            if (!(most * most - dot(difference, difference)).not_negative()) fail("the points are not near each other");
        } else {
            const Body &body = read_side(), &target = other(body);
            const size_t face = in.number(body.faces()), corner = in.number(body.size(face));
            const size_t triangle = read_convex_face(target), k = in.number(target.size(triangle) - 1, 1);
            check_cross(placed(body, face, corner), placed(body, face, (corner + 1) % body.size(face)),
                        {placed(target, triangle, 0), placed(target, triangle, k), placed(target, triangle, k + 1)});
        }
    }

    static void check_cross(const Enclosure& p, const Enclosure& q, const Triple<Enclosure>& t) {
        const Enclosure normal = cross(t[1] - t[0], t[2] - t[0]);
        if (normal[0].sign() == 0 && normal[1].sign() == 0 && normal[2].sign() == 0) fail("the triangle has no area");
        Interval a = dot(normal, p - t[0]), b = dot(normal, q - t[0]);
        if (a.sign() == 0 && b.sign() == 0) fail("the edge is in the plane of the triangle");
        if (a.middle < 0 || b.middle > 0) a = -a, b = -b;
        if (!a.not_negative() || !(-b).not_negative()) fail("the edge is on one side of the triangle");
        const Enclosure meeting = a * q - b * p;  // times a - b
        for (size_t i = 0; i < 3; ++i)
            if (!dot(normal, cross(t[(i + 1) % 3] - t[i], meeting - (a - b) * t[i])).not_negative())
                fail("the edge meets the plane outside of the triangle");
    }
};

// ---- The file ----------------------------------------------------------------------------------------------------

struct Checker {
    Reader& in;
    vector<Body> bodies{};
    Verdict verdict{};
    double margin = 0;  // of a scene: that of the last pair
    string claims{};

    string check(const vector<Mesh>& meshes) {
        for (const Mesh& mesh : meshes) {
            bodies.push_back({bodies.empty() ? "moving " : bodies.size() == 1 ? "fixed " : ""});
            bodies.back().read(mesh);
        }
        in.next("chasles", [&] { in.expect("certificate", in.word()), in.expect("1", in.word()); });
        const bool scene = in.peek() == "scene";
        scene ? read_scene() : read_pair();
        const bool start = verdict.kind == "start";
        size_t steps = 0;
        std::optional<Pair> touching;
        for (size_t i = 0; i < bodies.size(); ++i)
            for (size_t j = i + 1; j < bodies.size(); ++j) {
                const bool touches = verdict.kind != "clear" && i == verdict.i && j == verdict.j;
                if ((start && !touches) || (scene && !read_pair_line(i, j, touches))) continue;
                Pair pair(in, verdict, bodies[i], bodies[j], margin);
                for (Body& body : bodies)
                    if (!scene && !start) read_order(body, pair.side(body));
                if (!start) pair.check_proofs();
                steps += pair.steps;
                if (touches) touching.emplace(std::move(pair));
            }
        if (touching) in.next("witness", [&] { touching->check_witness(); });
        const Word word = in.any_word();
        if (!word.empty()) fail("unexpected word " + quote(word) + " after the end");
        return claims + "\npieces " + to_string(verdict.pieces) + "\nsteps " + to_string(steps);
    }

    static string text(string name, const vector<double>& numbers) {
        for (double x : numbers) {
            std::array<char, 32> digits;  // the shortest that are read as x
            name += ' ', name.append(&digits[0], std::to_chars(&digits[0], &digits[0] + 32, x).ptr);
        }
        return name;
    }

    void read_pair() {
        if (bodies.size() != 2) fail("a certificate of a pair needs two meshes");
        Body &moving = bodies[0], &fixed = bodies[1];
        for (Body* body : {&moving, &fixed})
            in.next(body == &moving ? "moving" : "fixed", [&] {
                if (in.word() != body->hash) fail("the hash is that of another " + body->name + "body");
                if (in.number(MOST_FACES) != body->faces()) fail("wrong number of faces");
            });
        in.next("solid", [&] {
            const string solid(in.word());
            moving.solid = solid == "moving" || solid == "both";
            fixed.solid = solid == "fixed" || solid == "both";
            if (!moving.solid && !fixed.solid && solid != "none") fail("unknown word " + quote(solid));
            claims = "\nsolid " + solid;
        });
        for (const Body& body : bodies) body.check_solid();
        in.next("radius", [&] { moving.radius = in.not_negative(), fixed.radius = in.not_negative(); });
        in.next("margin", [&] { margin = in.not_negative(); });
        claims = text("\nmargin", {margin}) + text("\nradius", {moving.radius, fixed.radius}) + claims;
        string kind;
        in.next("motion", [&] {
            kind = in.word();
            if (kind != "screw" && kind != "sweep" && kind != "chain") fail("unknown motion " + quote(kind));
            verdict.pieces = in.number(MOST_PIECES + 1, 1);
            moving.links.resize(kind == "chain" ? in.number(MOST_LINKS + 1, 1) : 1);
        });
        claims += "\nmotion " + kind;
        if (kind == "chain") read_links(moving);
        else moving.links[0].kind = kind, moving.links[0].size = 7;
        if (kind == "sweep") {
            in.next("centre", [&] { read_vector(moving.links[0]); });
            moving.lengths.add(moving.links[0].fixed);
            claims += text("\ncentre", moving.links[0].fixed);
        }
        read_knots(moving, kind == "chain" ? "knot" : "pose");
        read_verdict(false);
    }

    void read_scene() {
        const vector<Body> meshes = std::move(bodies);
        vector<bool> used(meshes.size(), false);
        size_t count = 0;
        in.next("scene", [&] {
            count = in.number(MOST_BODIES + 1, 2), verdict.pieces = in.number(MOST_PIECES + 1, 1);
        });
        for (bodies.clear(); bodies.size() < count;) {
            in.next("body", [&] {
                const string hash(in.word());
                size_t mesh = 0;
                while (mesh < meshes.size() && meshes[mesh].hash != hash) ++mesh;
                if (mesh == meshes.size()) fail("no mesh has the hash " + quote(hash));
                used[mesh] = true;
                bodies.push_back(meshes[mesh]);
                Body& body = bodies.back();
                body.name.clear();
                if (in.number(MOST_FACES) != body.faces()) fail("wrong number of faces");
                const string type(in.word());
                if (type != "solid" && type != "surface") fail("unknown word " + quote(type));
                body.solid = type == "solid", body.radius = in.not_negative();
                body.links.resize(in.number(MOST_LINKS + 1));
                claims += "\nbody " + to_string(bodies.size() - 1) + " " + hash;
                claims += text(" " + type + " radius", {body.radius});
            });
            Body& body = bodies.back();
            body.check_solid();
            read_links(body);
            if (std::any_of(body.links.begin(), body.links.end(), [](const Link& link) { return link.size > 0; }))
                read_knots(body, "knot");
            read_order(body, "");
        }
        if (std::find(used.begin(), used.end(), false) != used.end()) fail("a mesh is of no body, or given twice");
        read_verdict(true);
    }

    void read_order(Body& body, const string& side) {
        body.node_points.resize(2 * body.faces() - 1);
        in.next("order", [&] {
            if (!side.empty()) in.expect(side, in.word());
            vector<bool> used(body.faces(), false);
            for (size_t i = 0; i < body.faces(); ++i) {
                body.order.push_back(uint32_t(in.number(body.faces())));
                if (used[body.order[i]]) fail("face " + to_string(body.order[i]) + " is twice in the order");
                used[body.order[i]] = true;
            }
        });
    }

    void read_verdict(bool scene) {
        in.next("verdict", [&] {
            string& kind = verdict.kind = in.word();
            string what = "verified: " + kind;
            if (kind == "contact") {
                verdict.piece = in.number(verdict.pieces);
                verdict.lower = in.not_negative(), verdict.upper = in.not_negative();
                if (!(verdict.lower <= verdict.upper && verdict.upper <= 1))
                    fail("LOWER and UPPER are not in order in [0, 1]");
                what += text(" " + to_string(verdict.piece), {verdict.lower, verdict.upper});
            } else if (kind == "clear") {
                verdict.piece = verdict.pieces - 1, verdict.lower = 1;
            } else if (kind != "start") {
                fail("unknown verdict " + quote(kind));
            }
            if (scene && kind != "clear") {
                verdict.i = in.number(bodies.size()), verdict.j = in.number(bodies.size(), verdict.i + 1);
                what += " " + to_string(verdict.i) + " " + to_string(verdict.j);
            }
            claims = what + claims;
        });
    }

    bool read_pair_line(size_t i, size_t j, bool touches) {  // whether the pair is tested
        const bool tested = touches || in.peek() != "untested";
        const string pair = " " + to_string(i) + " " + to_string(j);
        in.next(tested ? "pair" : "untested", [&] {
            if (in.number(bodies.size()) != i || in.number(bodies.size()) != j) fail("not the pair" + pair);
            if (tested) margin = in.not_negative();
        });
        claims += tested ? text("\npair" + pair + " margin", {margin}) : "\nuntested" + pair;
        return tested;
    }

    void read_vector(Link& link) {
        while (link.fixed.size() < 3) link.fixed.push_back(in.real());
    }

    void read_pose(vector<double>& numbers, Range& lengths) {
        for (size_t i = 0; i < 7; ++i) numbers.push_back(in.real());
        const double* x = &numbers.back() - 6;
        if (x[3] == 0 && Corner{x[4], x[5], x[6]} == Corner{}) fail("a quaternion of length 0");
        lengths.add(Corner{x[0], x[1], x[2]});
    }

    void read_links(Body& body) {
        static const std::map<string, size_t> SIZES = {
            {"pose", 0}, {"slide", 1}, {"turn", 1}, {"velocity", 7}, {"twist", 7}};
        for (Link& link : body.links)
            in.next("link", [&] {
                link.kind = in.word();
                link.back = link.kind == "back";
                if (link.back) link.kind = in.word();
                if (!SIZES.contains(link.kind)) fail("unknown link " + quote(link.kind));
                link.size = SIZES.at(link.kind);
                if (link.kind == "pose") read_pose(link.fixed, body.lengths);
                else if (link.kind != "twist") read_vector(link);
                if (link.kind == "velocity") body.lengths.add(link.fixed);
                if (link.kind == "turn" && link.fixed == vector<double>(3)) fail("a direction that is 0");
                claims += text((link.back ? "\nlink back " : "\nlink ") + link.kind, link.fixed);
            });
    }

    void read_knots(Body& body, const string& keyword) {
        for (size_t knot = 0; knot <= verdict.pieces; ++knot) {
            const bool printed = knot == 0 || knot == verdict.pieces;
            if (printed) claims += (knot == 0 ? "\nfirst " : "\nlast ") + keyword;
            in.next(keyword, [&] {
                for (Link& link : body.links) {
                    vector<double>& numbers = link.numbers;
                    if (link.size == 1) numbers.push_back(in.real());
                    if (link.kind == "slide") body.lengths.add(std::array{numbers.back()});
                    if (link.between_poses()) read_pose(numbers, body.lengths);
                    if (link.is_cubic() && in.more()) read_pose(numbers, body.lengths);
                    if (knot == 0) link.size = numbers.size();
                    if (numbers.size() != link.size * (knot + 1)) fail("poses of seven and of fourteen numbers");
                    if (printed) claims += text("", {numbers.end() - long(link.size), numbers.end()});
                }
                for (const Link& link : body.links)  // the unit of length does not matter
                    if (link.between_poses() && knot > 0)
                        turn(pose_at(link, knot - 1, SMALLEST).q, pose_at(link, knot, SMALLEST).q);
            });
        }
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
    if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
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
    if (!binary && data.starts_with("\xEF\xBB\xBF")) data.erase(0, 3);  // a mark of the byte order
    if (!binary && data.find('\n') == string::npos) std::replace(data.begin(), data.end(), '\r', '\n');
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

Verified verify(const vector<Mesh>& meshes, std::istream& certificate) {
    Reader reader{certificate, false, true};
    try {
        return {true, Checker{reader}.check(meshes)};
    } catch (const std::exception& reason) {  // std::bad_alloc too
        return {false, "not verified: line " + to_string(reader.line) + ": " + reason.what()};
    }
}

}  // namespace certificate

#ifndef CERTIFICATE_NO_MAIN
int main(int argc, char** argv) {
    std::error_code error;
    for (int i = 1; i < std::max(argc, 2); ++i)
        if (argc < 3 || !std::filesystem::is_regular_file(argv[i], error) || !std::ifstream(argv[i])) {
            std::cerr << (argc < 3 ? "usage: verify MESH [MESH ...] CERTIFICATE" : "cannot read a file") << std::endl;
            return 2;
        }
    certificate::Verified result;
    try {
        std::vector<certificate::Mesh> meshes;
        for (int i = 1; i < argc - 1; ++i) meshes.push_back(certificate::read_mesh(argv[i]));
        std::ifstream file(argv[argc - 1], std::ios::binary);
        result = certificate::verify(meshes, file);
    } catch (const std::exception& reason) {
        result.message = std::string("not verified: ") + reason.what();
    }
    std::cout << result.message << std::endl;
    return result.holds && std::cout ? 0 : 1;
}
#endif
