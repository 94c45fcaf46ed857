// Output through C streams, because they report the reason of a failure (errno).
#include "cli/output.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/read_file.h"
#include "chasles/io/text_scan.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <set>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace chasles::cli {
namespace {

namespace fs = std::filesystem;

// Returns 0 on success, otherwise the system's error number.
int write_all(std::FILE* file, const std::string& text) {
    errno = 0;
    const bool is_written = std::fwrite(text.data(), 1, text.size(), file) == text.size() && std::fflush(file) == 0;
    return is_written ? 0 : (errno != 0 ? errno : EIO);
}

std::string why_not(int error) {
    return std::string(": cannot be written: ") + std::strerror(error);
}

/// Names from files must not steer a terminal. Control characters of ASCII and of Latin 1 become escapes like \u009b,
/// which mean the same characters where the text is JSON.
std::string with_escapes(const std::string& text) {
    constexpr unsigned char first_byte = 0xc2; // of U+0080 to U+00BF in UTF-8
    std::string shown;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]), next = static_cast<unsigned char>(text[i + 1]);
        const bool is_latin = byte == first_byte && next >= 0x80 && next < 0xa0;
        if (is_latin || (byte < 0x20 && byte != '\n' && byte != '\t') || byte == 0x7f)
            shown += fmt::format("\\u{:04x}", is_latin ? next : byte);
        else
            shown += text[i];
        i += is_latin ? 1 : 0;
    }
    return shown;
}

/// The files that this program is about to write, each with its part.
std::set<fs::path>& targets() {
    static std::set<fs::path> files;
    return files;
}

/// Each name of a file once, also of one that does not exist yet.
fs::path only_name(const fs::path& file) {
    return fs::weakly_canonical(fs::absolute(file));
}

/// The parts that an interruption removes. A handler of a signal reads them, so their names stay in memory.
std::array<std::atomic<const char*>, 4> unfinished{};
static_assert(std::atomic<const char*>::is_always_lock_free);

void set_unfinished(const fs::path& part) {
    static std::set<std::string> names;
    const char* const name = names.insert(part.string()).first->c_str();
    for (std::atomic<const char*>& place : unfinished)
        if (const char* empty = nullptr; place.compare_exchange_strong(empty, name))
            return;
}

void set_finished(const fs::path& part) {
    for (std::atomic<const char*>& place : unfinished)
        if (const char* const name = place; name != nullptr && part == name)
            place = nullptr;
}

/// The file behind links, also where it does not exist yet.
fs::path target_of(const std::string& name) {
    constexpr int most_links = 40;
    fs::path file = name;
    std::error_code ignored;
    for (int links = 0; fs::is_symlink(file, ignored); ++links) {
        if (links == most_links)
            throw InvalidInput(io::one_line(name) + why_not(ELOOP));
        file = file.parent_path() / fs::read_symlink(file, ignored);
    }
    return file;
}

/// Pipes and devices cannot be replaced.
bool is_replaceable(const std::string& name) {
    std::error_code ignored;
    const fs::file_status status = fs::status(name, ignored);
    return !is_standard_output(name) && (!fs::exists(status) || fs::is_regular_file(status));
}

/// A descriptor for writing, or -1. The file is created if it is missing, and never emptied. A link is not followed.
int open_for_writing(const fs::path& file) {
    return open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
}

void require_unread(const fs::path& file) {
    if (io::ReadLog::has(file))
        throw InvalidInput(io::shown_name(file) + ": is an input of this command; give the output another name");
}

} // namespace

void prepare_output() {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(stream, F_GETFD) < 0) // reading from it, or writing to it, goes on failing
            open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

bool is_standard_output(const std::string& name) {
    struct stat file = {}, output = {};
    return stat(name.c_str(), &file) == 0 && fstat(STDOUT_FILENO, &output) == 0 && file.st_dev == output.st_dev &&
           file.st_ino == output.st_ino;
}

void remove_unfinished() noexcept {
    for (const std::atomic<const char*>& place : unfinished)
        if (const char* const name = place)
            unlink(name);
}

void print(const std::string& text) {
    if (const int error = write_all(stdout, with_escapes(text)); error != 0)
        throw InvalidInput("standard output" + why_not(error));
}

OutputFile::OutputFile(const std::string& name, Leftover leftover)
    : name_(name), target_(target_of(name)), leftover_(leftover) {
    if (name == "-")
        throw InvalidInput("-: is no file: name a file, ./- for one of this name, or /dev/stdout");
    require_unread(name);
    if (!is_replaceable(name)) {
        // through a descriptor of its own to where standard output goes, at the same position
        file_.reset(is_standard_output(name) ? fdopen(dup(STDOUT_FILENO), "w") : std::fopen(name.c_str(), "a"));
        if (!file_)
            fail(errno);
        return;
    }
    part_ = target_;
    part_ += ".part";
    require_unread(part_);
    check_part();
    if (targets().contains(only_name(target_)) || targets().contains(only_name(part_)))
        throw InvalidInput(io::one_line(name) + ": is named by two options; give each output a name of its own");
    targets().insert({only_name(target_), only_name(part_)});
}

OutputFile::~OutputFile() {
    if (part_.empty())
        return;
    targets().erase(only_name(target_));
    targets().erase(only_name(part_));
    if (file_ && !keeps_rows_)
        unlink(part_.c_str());
    set_finished(part_);
}

/// Finds errors before the work. Leaves no file behind, in case the program is interrupted before the first write.
void OutputFile::check_part() const {
    std::error_code ignored;
    const bool is_left = fs::exists(part_, ignored);
    if (is_left && leftover_ == Leftover::refused)
        throw InvalidInput(io::shown_name(part_) +
                           ": is left by a run that was cut; go on from it with --resume, or remove it");
    if (fs::exists(target_, ignored) && access(target_.c_str(), W_OK) != 0)
        fail(errno);
    const int descriptor = open_for_writing(part_);
    if (descriptor < 0)
        fail(errno);
    ::close(descriptor);
    if (!is_left)
        unlink(part_.c_str());
}

/// Opens FILE.part for the first write. Another program that writes it holds a lock.
void OutputFile::open_part() {
    const int descriptor = open_for_writing(part_);
    if (descriptor < 0)
        fail(errno);
    file_.reset(fdopen(descriptor, "w"));
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        keeps_rows_ = true; // they are the other program's
        throw InvalidInput(io::one_line(name_) + ": is being written by another program");
    }
    if (!keeps_rows_)
        set_unfinished(part_);
    struct stat former = {};
    if (stat(target_.c_str(), &former) == 0)
        static_cast<void>(fchmod(descriptor, former.st_mode & 07777U));
    if (ftruncate(descriptor, off_t(kept_bytes_)) != 0 || lseek(descriptor, 0, SEEK_END) < 0)
        fail(errno);
}

void OutputFile::keep_rows() {
    keeps_rows_ = true;
    set_finished(part_);
}

std::string OutputFile::kept_rows() const {
    std::error_code ignored;
    const bool is_left = leftover_ == Leftover::continued && fs::file_size(part_, ignored) > 0 && !ignored;
    return is_left ? io::read_file(part_) : "";
}

void OutputFile::write(const std::string& text) {
    if (!file_)
        open_part();
    if (const int error = write_all(file_.get(), text); error != 0)
        fail(error);
}

void OutputFile::close() {
    if (!file_)
        write("");
    if (!part_.empty() && (fsync(fileno(file_.get())) != 0 || std::rename(part_.c_str(), target_.c_str()) != 0))
        fail(errno);
    if (std::fclose(file_.release()) != 0)
        fail(errno);
}

void OutputFile::fail(int error) const {
    throw InvalidInput(io::one_line(name_) + why_not(error));
}

} // namespace chasles::cli
