#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "readers.h"

/// Feeds readers with mutations of valid files, without any fuzzing engine.
///
/// floc_mutate READER RUNS [SEED] reads mutated files. If the reader crashes, hangs or takes too much memory, the input
/// is written to a file.
/// floc_mutate READER FILE... reads each of these files once.
/// floc_mutate --seeds DIR writes the valid inputs to one folder per reader. libFuzzer can start from these inputs.
namespace floc::fuzz {
namespace {

constexpr time_t kMaxSeconds = 10;              ///< limit of processor time per input (s)
constexpr rlim_t kMaxMemory = rlim_t{1} << 30;  ///< limit of the address space of the process (bytes)
constexpr std::size_t kLongestInput = 1 << 16;

std::string current;  ///< input that is being read, which the signal handler saves
const char* reader_name = "";

/// Saves the input whose reading has raised a fatal signal. Calls only functions that are allowed in a signal handler.
void keep_input(int signal) {
  char name[200];
  std::snprintf(name, sizeof name, "crash-%s-%d", reader_name, signal);
  if (std::FILE* file = std::fopen(name, "wb")) {
    std::fwrite(current.data(), 1, current.size(), file);
    std::fclose(file);
  }
  std::fprintf(stderr, "%s: %s; the input is in %s\n", reader_name, signal == SIGPROF ? "hangs" : "dies", name);
  _exit(1);
}

/// Numbers and words at which a reader may fail.
const char* const kTokens[] = {"0",
                               "-1",
                               "1e308",
                               "-1e308",
                               "1e-320",
                               "nan",
                               "inf",
                               "2147483648",
                               "4294967296",
                               "9223372036854775807",
                               "-9223372036854775808",
                               "1e19",
                               "1e9",
                               "",
                               "\"",
                               "{",
                               "}",
                               "[",
                               "]",
                               "=",
                               ",",
                               ";",
                               "\t",
                               "\n",
                               "#",
                               "\r",
                               "ITEM: ",
                               "\xef\xbb\xbf",
                               "1.2.3",
                               "0x10"};

class Mutator {
 public:
  Mutator(std::vector<std::string> seeds, unsigned seed) : seeds_(std::move(seeds)), engine_(seed) {}

  std::string next() {
    std::string text = seeds_[below(seeds_.size())];
    if (text.size() > kLongestInput) text = text.substr(below(text.size() - kLongestInput), kLongestInput);
    for (std::size_t n = 1 + below(8); n > 0; --n) change(text);
    return text;
  }

 private:
  std::size_t below(std::size_t n) { return n == 0 ? 0 : engine_() % n; }

  void change(std::string& text) {
    const std::size_t at = below(text.size() + 1);
    const std::size_t length = std::min(below(20) + 1, text.size() - at);
    switch (below(8)) {
      case 0:
        if (at < text.size()) text[at] = static_cast<char>(below(256));
        break;
      case 1:
        if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(at, text.substr(below(text.size() + 1), below(200)));
        break;
      case 4:
        text.insert(at, kTokens[below(std::size(kTokens))]);
        break;
      case 5:
        replace_number(text, at);
        break;
      case 6:
        text.resize(at);
        break;
      default: {
        const std::string& other = seeds_[below(seeds_.size())];
        text = text.substr(0, at) + other.substr(below(other.size() + 1), kLongestInput);
      }
    }
  }

  /// Replaces the first number that begins after the position `at` by another number.
  void replace_number(std::string& text, std::size_t at) {
    constexpr const char* kDigits = "0123456789.eE+-";
    const std::size_t begin = text.find_first_of("0123456789", at);
    if (begin == std::string::npos) return;
    const std::size_t end = std::min(text.find_first_not_of(kDigits, begin), text.size());
    text.replace(begin, end - begin, kTokens[below(std::size(kTokens))]);
  }

  std::vector<std::string> seeds_;
  std::mt19937 engine_;
};

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Requests the signal SIGPROF after the given processor time (s); 0 cancels the request.
void set_timer(time_t seconds) {
  const itimerval timer{{0, 0}, {seconds, 0}};
  ::setitimer(ITIMER_PROF, &timer, nullptr);
}

void read_one(const Reader& reader, std::string bytes) {
  current = std::move(bytes);
  set_timer(kMaxSeconds);
  reader.read(current);
  set_timer(0);
}

int write_seeds(const std::filesystem::path& directory) {
  for (const Reader& reader : readers()) {
    std::filesystem::create_directories(directory / reader.name);
    int n = 0;
    for (const std::string& seed : reader.seeds())
      std::ofstream(directory / reader.name / std::to_string(n++), std::ios::binary) << seed;
  }
  return 0;
}

int run(const Reader& reader, int argc, char** argv) {
  reader_name = reader.name;
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL, SIGPROF}) std::signal(signal, keep_input);
  const rlimit limit{kMaxMemory, kMaxMemory};
  ::setrlimit(RLIMIT_AS, &limit);
  char* end = nullptr;
  const long runs = std::strtol(argv[2], &end, 10);
  if (*end != '\0') {
    for (int k = 2; k < argc; ++k) read_one(reader, bytes_of(argv[k]));
    return 0;
  }
  const std::vector<std::string> seeds = reader.seeds();
  for (const std::string& seed : seeds) read_one(reader, seed);
  Mutator mutator(seeds, argc > 3 ? static_cast<unsigned>(std::atoi(argv[3])) : 1);
  for (long k = 0; k < runs; ++k) read_one(reader, mutator.next());
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  std::printf("%s: %ld inputs, at most %ld MB\n", reader.name, runs, usage.ru_maxrss / 1024);
  return 0;
}

int main_of(int argc, char** argv) {
  if (argc == 3 && std::string(argv[1]) == "--seeds") return write_seeds(argv[2]);
  for (const Reader& reader : readers())
    if (argc >= 3 && std::string(argv[1]) == reader.name) return run(reader, argc, argv);
  std::fprintf(stderr, "usage: floc_mutate READER RUNS [SEED] | READER FILE... | --seeds DIR; readers:");
  for (const Reader& reader : readers()) std::fprintf(stderr, " %s", reader.name);
  std::fprintf(stderr, "\n");
  return 2;
}

}  // namespace
}  // namespace floc::fuzz

int main(int argc, char** argv) {
  return floc::fuzz::main_of(argc, argv);
}
