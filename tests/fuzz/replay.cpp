#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz_target.hpp"

// A fuzz target without libFuzzer, so that ctest needs no clang: every seed as it is, then some
// thousand mutations of seeds, the same in every run. tools/fuzz searches further, guided by
// coverage and under sanitizers.
//
//   <target>_replay MUTATIONS DICTIONARY SEED_DIRECTORY...
//
// The input at which it crashed or found something is left in <target>_replay.input.

namespace hamjet::fuzz {
namespace {

using Generator = std::mt19937_64;

constexpr std::size_t longest_input = 16384;
constexpr rlim_t most_memory = rlim_t{1} << 30;

/// A random number below `count`; the standard's distributions differ between libraries.
std::size_t below(std::size_t count, Generator& random) { return random() % count; }

std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot be read: " + file.string());
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> seeds_in(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  if (files.empty()) throw std::runtime_error("no seeds in " + directory.string());
  std::sort(files.begin(), files.end());
  std::vector<std::string> seeds;
  std::transform(files.begin(), files.end(), std::back_inserter(seeds), content);
  return seeds;
}

/// The words of a dictionary of libFuzzer: lines "word", with \xAB, \\ and \" in them.
std::vector<std::string> words_in(const std::filesystem::path& dictionary) {
  std::ifstream stream(dictionary);
  std::vector<std::string> words;
  for (std::string line; std::getline(stream, line);) {
    if (line.size() < 2 || line.front() != '"' || line.back() != '"') continue;
    std::string word;
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
      if (line[i] != '\\') {
        word += line[i];
      } else if (line[++i] == 'x') {
        word += static_cast<char>(std::stoi(line.substr(i + 1, 2), nullptr, 16));
        i += 2;
      } else {
        word += line[i];
      }
    }
    words.push_back(word);
  }
  if (words.empty()) throw std::runtime_error("no words in " + dictionary.string());
  return words;
}

/// Changes seeds as bytes, words and lines.
class Mutator {
 public:
  Mutator(const std::vector<std::string>& seeds, const std::vector<std::string>& words)
      : seeds_(seeds), words_(words) {}

  std::string next() {
    std::string text = seeds_[below(seeds_.size(), random_)];
    for (std::size_t count = 1 + below(4, random_); count > 0; --count) mutate(text);
    if (text.size() > longest_input) text.resize(longest_input);
    return text;
  }

 private:
  struct Range {
    std::size_t begin, length;
  };

  std::size_t place(const std::string& text) { return below(text.size() + 1, random_); }

  /// A run of letters, digits and other characters of numbers, from a random place on.
  Range word(const std::string& text) {
    constexpr const char* letters =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_+-.";
    const std::size_t begin = std::min(text.find_first_of(letters, place(text)), text.size());
    const std::size_t end = std::min(text.find_first_not_of(letters, begin), text.size());
    return {begin, end - begin};
  }

  Range line(const std::string& text) {
    const std::size_t before = text.rfind('\n', place(text));
    const std::size_t begin = before == std::string::npos ? 0 : std::min(before + 1, text.size());
    const std::size_t end = std::min(text.find('\n', begin), text.size() - 1);
    return {begin, text.empty() ? 0 : end + 1 - begin};
  }

  void mutate(std::string& text) {
    const Range a_word = word(text);
    const Range a_line = line(text);
    const std::string& new_word = words_[below(words_.size(), random_)];
    switch (below(10, random_)) {
      case 0:  // one bit of a byte
        if (!text.empty())
          text[below(text.size(), random_)] ^= static_cast<char>(1 << below(8, random_));
        break;
      case 1:  // one byte more
        text.insert(place(text), 1, static_cast<char>(below(256, random_)));
        break;
      case 2:  // some bytes fewer
        text.erase(place(text), 1 + below(8, random_));
        break;
      case 3:
        text.insert(place(text), new_word);
        break;
      case 4:
        text.replace(a_word.begin, a_word.length, new_word);
        break;
      case 5:  // another word of the text
      {
        const Range other = word(text);
        text.replace(a_word.begin, a_word.length, text.substr(other.begin, other.length));
        break;
      }
      case 6:
        text.erase(a_line.begin, a_line.length);
        break;
      case 7:  // one line twice, or at another place
        text.insert(line(text).begin, text.substr(a_line.begin, a_line.length));
        break;
      case 8:  // the end of another seed
      {
        const std::string& other = seeds_[below(seeds_.size(), random_)];
        text.resize(place(text));
        text += other.substr(place(other));
        break;
      }
      default:
        text.replace(a_word.begin, a_word.length, number());
        break;
    }
  }

  std::string number() {
    constexpr std::array numbers = {"0",    "-0",     "-1",    "1",      "2",    "3",
                                    "21",   "1e-300", "1e300", "5e-324", "0.1",  "1000000000",
                                    "1e30", "-1e-30", "1e15",  "1e-15",  "0.99", "360"};
    return numbers[below(numbers.size(), random_)];
  }

  const std::vector<std::string>& seeds_;
  const std::vector<std::string>& words_;
  Generator random_{20261121};
};

/// The current input and the file in which it is kept if the program ends early. They are for the
/// handler, which may neither allocate nor lock.
std::string_view input_at_work;
std::string kept_input;

extern "C" void keep_input(int signal) {
  const int file = ::open(kept_input.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  [[maybe_unused]] const auto ignored = ::write(file, input_at_work.data(), input_at_work.size());
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void run(const std::string& input) {
  input_at_work = input;
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
}

/// Memory beyond this limit is a finding: an allocation fails with an exception of an unexpected
/// kind.
void limit_memory() {
#ifndef __SANITIZE_ADDRESS__  // the sanitizer reserves terabytes
  const rlimit limit{most_memory, most_memory};
  if (::setrlimit(RLIMIT_AS, &limit) != 0) throw std::runtime_error("no limit of memory");
#endif
}

void replay(const std::vector<std::string>& arguments) {
  if (arguments.size() < 4) throw std::runtime_error("arguments: MUTATIONS DICTIONARY SEEDS...");
  limit_memory();
  kept_input = std::filesystem::path(arguments[0]).filename().string() + ".input";
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) {
    std::signal(signal, keep_input);
  }
  const std::vector<std::string> words = words_in(arguments[2]);
  std::vector<std::string> seeds;
  for (std::size_t i = 3; i < arguments.size(); ++i) {
    const auto more = seeds_in(arguments[i]);
    seeds.insert(seeds.end(), more.begin(), more.end());
  }
  for (const std::string& seed : seeds) run(seed);
  Mutator mutator(seeds, words);
  const long mutations = std::stol(arguments[1]);
  for (long i = 0; i < mutations; ++i) run(mutator.next());
  std::printf("%zu seeds and %ld mutations, no finding\n", seeds.size(), mutations);
}

}  // namespace
}  // namespace hamjet::fuzz

int main(int argument_count, char** arguments) {
  try {
    hamjet::fuzz::replay({arguments, arguments + argument_count});
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
