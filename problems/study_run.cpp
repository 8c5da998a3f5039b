// Runs the points of a study as child processes.
#include "problems/study.hpp"

#include "core/error.hpp"
#include "core/io/summary.hpp"
#include "problems/run_session.hpp"

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace ballast {

namespace {

namespace fs = std::filesystem;

volatile std::sig_atomic_t stop_asked = 0;
void on_stop(int) { stop_asked = 1; }

struct Job {
  StudyPoint point;
  std::string deck;
};

/// Of this program's file, FNV-1a 64 bit: what another build made is not this one's answer.
std::string program_hash() {
  std::ifstream in("/proc/self/exe", std::ios::binary);
  std::uint64_t h = 1469598103934665603ULL;
  std::vector<char> piece(1 << 16);
  while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())) || in.gcount() > 0) {
    for (std::streamsize i = 0; i < in.gcount(); ++i) {
      h = (h ^ static_cast<unsigned char>(piece[static_cast<std::size_t>(i)])) * 1099511628211ULL;
    }
  }
  return fmt::format("{:016x}", h);
}
const std::string& this_program() {
  static const std::string hash = program_hash();
  return hash;
}

/// What a point's folder says of an earlier run of the same deck by the same program.
enum class Left { nothing, done, part };
Left left_by_earlier(const fs::path& folder, const std::string& hash) {
  std::ifstream in(folder / "summary.json"), cost(folder / "study.json");
  const auto j = nlohmann::json::parse(in, nullptr, false), c = nlohmann::json::parse(cost, nullptr, false);
  if (j.is_discarded() || j.value("deck_hash", "") != hash || c.is_discarded() || c.value("program", "") != this_program()) {
    return Left::nothing;
  }
  const std::string ended = j.value("ended", "");
  if (ended == "interrupted" && fs::exists(folder / "checkpoint.h5")) {
    return Left::part;
  }
  return ended == "finished" || ended == "failed" ? Left::done : Left::nothing;
}

/// Processor time of the runs so far of a point (s), and what they had of memory (byte).
struct Cost {
  double cpu = 0, peak_memory = 0;
};
Cost cost_of(const fs::path& folder) {
  std::ifstream in(folder / "study.json");
  const auto j = nlohmann::json::parse(in, nullptr, false);
  return j.is_discarded() ? Cost{} : Cost{j.value("cpu_seconds", 0.0), j.value("peak_memory_bytes", 0.0)};
}
void write_cost(const fs::path& folder, const Cost& cost) {
  const nlohmann::ordered_json j = {{"cpu_seconds", cost.cpu}, {"peak_memory_bytes", cost.peak_memory}, {"program", this_program()}};
  io::write_text_atomically(folder / "study.json", j.dump(2) + "\n");
}

double seconds(const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); }

/// This program again, as `run`; its output goes to run.log in the folder.
pid_t start(const Job& job, const fs::path& folder, int threads, bool restart) {
  std::vector<std::string> words = {"ballast", "run", job.deck, "--out", folder.string(), "--threads", std::to_string(threads)};
  for (const std::string& setting : job.point.settings) {
    words.insert(words.end(), {"--set", setting});
  }
  if (restart) {
    words.insert(words.end(), {"--restart", (folder / "checkpoint.h5").string()});
  }
  std::vector<char*> argv;
  for (std::string& w : words) {
    argv.push_back(w.data());
  }
  argv.push_back(nullptr);
  const std::string log = (folder / "run.log").string();
  sigset_t stops, before;
  sigemptyset(&stops);
  sigaddset(&stops, SIGINT);
  sigaddset(&stops, SIGTERM);
  sigprocmask(SIG_BLOCK, &stops, &before); // none is lost between fork and exec
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    sigprocmask(SIG_SETMASK, &before, nullptr);
    const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (out >= 0) {
      dup2(out, STDOUT_FILENO);
      dup2(out, STDERR_FILENO);
    }
    execv("/proc/self/exe", argv.data());
    _exit(127);
  }
  sigprocmask(SIG_SETMASK, &before, nullptr);
  if (child < 0) {
    throw Error("study: no new process could be started");
  }
  return child;
}

class Runner {
public:
  Runner(const fs::path& folder, int jobs, int threads) : folder_(folder), jobs_(jobs), threads_(threads) {}

  /// False: interrupted.
  bool run(const std::vector<Job>& all) {
    start_ = std::chrono::steady_clock::now();
    std::size_t next = 0;
    while ((next < all.size() && stop_asked == 0) || !running_.empty()) {
      while (next < all.size() && stop_asked == 0 && static_cast<int>(running_.size()) < jobs_) {
        begin(all, next++);
      }
      if (!running_.empty()) {
        wait_for_one(all);
      }
    }
    return stop_asked == 0;
  }

private:
  void begin(const std::vector<Job>& all, std::size_t index) {
    const StudyPoint& p = all[index].point;
    const fs::path folder = folder_ / p.name;
    const Left left = left_by_earlier(folder, p.hash);
    if (left == Left::done) {
      ++done_;
      report(all, index, "kept from an earlier run");
      return;
    }
    const Cost before = left == Left::part ? cost_of(folder) : Cost{};
    if (left != Left::part) {
      claim_folder(folder);
    }
    running_[start(all[index], folder, threads_, left == Left::part)] = {index, before};
  }

  void wait_for_one(const std::vector<Job>& all) {
    int status = 0;
    rusage used{};
    auto at = running_.begin();
    pid_t ended = 0;
    for (; at != running_.end() && ended == 0; at = ended == 0 ? std::next(at) : at) {
      ended = wait4(at->first, &status, WNOHANG, &used); // -1: it is gone, nobody knows how
    }
    if (ended == 0) {
      constexpr double again = 2; // s: a run that was still starting had no ear for it
      if (stop_asked != 0 && (!handed_on_ || seconds_since(*handed_on_) > again)) { // the runs write their checkpoints and end
        handed_on_ = std::chrono::steady_clock::now();
        for (const auto& [pid, what] : running_) {
          kill(pid, SIGTERM);
        }
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      return;
    }
    const auto [index, before] = at->second;
    running_.erase(at);
    const fs::path folder = folder_ / all[index].point.name;
    write_cost(folder, {before.cpu + seconds(used.ru_utime) + seconds(used.ru_stime),
                        std::max(before.peak_memory, 1024.0 * static_cast<double>(used.ru_maxrss))});
    ++done_;
    ++ran_;
    const int code = ended > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    report(all, index, code == 0 ? "finished" : code == 3 ? "stopped by a numerical failure" : code == 130 ? "interrupted"
           : fmt::format("ended with status {} (see {})", ended > 0 && WIFSIGNALED(status) ? 128 + WTERMSIG(status) : code, (folder / "run.log").string()));
  }

  void report(const std::vector<Job>& all, std::size_t index, const std::string& what) {
    const double wall = seconds_since(start_);
    const std::size_t left = all.size() - done_;
    const std::string eta = ran_ > 0 && left > 0 ? fmt::format(", about {:.0f} s left", wall / static_cast<double>(ran_) * static_cast<double>(left)) : "";
    fmt::print("[{}/{}] {}: {}  {:.0f} s{}\n", done_, all.size(), all[index].point.name, what, wall, eta);
    std::fflush(stdout);
  }

  struct Running {
    std::size_t index;
    Cost before;
  };
  fs::path folder_;
  int jobs_, threads_;
  std::map<pid_t, Running> running_;
  std::size_t done_ = 0, ran_ = 0;
  std::optional<std::chrono::steady_clock::time_point> handed_on_;
  std::chrono::steady_clock::time_point start_;
};

/// The row others are measured by: of those that finished the one with most cells; of equals none.
std::optional<std::size_t> finest(const std::vector<StudyRow>& rows) {
  std::optional<std::size_t> best;
  bool alone = false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].ended == "finished" && (!best || rows[i].cells >= rows[*best].cells)) {
      alone = !best || rows[i].cells > rows[*best].cells;
      best = i;
    }
  }
  return alone ? best : std::nullopt;
}

} // namespace

void require_one_finest(const std::vector<StudyPoint>& points) {
  const auto most = std::max_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.cells < b.cells; });
  std::string listed;
  int equals = 0;
  for (const StudyPoint& point : points) {
    constexpr int named = 8;
    if (point.cells == most->cells && ++equals <= named) {
      listed += fmt::format("{}{}", equals == 1 ? "" : ", ", point.name);
    }
  }
  if (equals > 1) {
    throw Error(fmt::format("--reference finest: {} runs have the most cells, {}: {}{}\n  allowed: one of these runs or another, a case or a deck by its "
                            "name, exact, or a run that has more cells than all others",
                            equals, most->cells, listed, equals > 8 ? ", ..." : ""));
  }
}

void claim_folder(const fs::path& folder) {
  fs::create_directories(folder);
  fs::remove(folder / "summary.json");
  write_cost(folder, {});
}

namespace {

/// The points as jobs; every deck is sound before the first run, and has an exact solution where one is asked for.
std::vector<Job> jobs_of(const StudyOptions& options, const std::vector<StudyCase>& cases, const std::vector<Variation>& variations) {
  std::vector<Job> jobs;
  std::vector<StudyPoint> points = cases.empty() ? study_points(variations, options.settings) : study_points(cases, variations, options.settings);
  for (StudyPoint& point : points) {
    const std::string deck = point.deck.empty() ? options.deck : point.deck;
    const ReadScene read = read_scene(deck, point.settings);
    point.hash = deck_hash(read);
    std::string why_not;
    if (options.reference == "exact" && !(options.exact && options.exact(read.scene, why_not))) {
      throw Error(fmt::format("--reference exact: {} ({}): {}", deck, point.name, why_not));
    }
    point.cells = cell_count(read.scene);
    jobs.push_back({point, deck});
  }
  if (options.reference == "finest") {
    require_one_finest(points);
  }
  return jobs;
}

/// Does --reference name this run, by itself or (with --case) by its case?
bool names(const std::string& reference, const std::string& run, const std::vector<std::string>& values) {
  return reference == run || (!values.empty() && reference == values[0]);
}

/// Errors of all rows by what the options name; the name of the reference, empty: none finished.
std::string measure(const StudyOptions& options, const fs::path& folder, bool by_deck, std::vector<StudyRow>& rows) {
  if (options.reference == "exact") {
    for (StudyRow& row : rows) {
      take_exact_errors(row);
    }
    return "the exact solution";
  }
  std::optional<std::size_t> reference = options.reference == "finest" ? finest(rows) : std::optional(rows.size() - 1);
  if (options.reference != "finest" && !by_deck) {
    const auto at = std::find_if(rows.begin(), rows.end(), [&](const StudyRow& row) { return names(options.reference, row.name, row.values); });
    reference = static_cast<std::size_t>(at - rows.begin());
  }
  if (!reference || rows[*reference].ended != "finished") {
    return "";
  }
  for (StudyRow& row : rows) {
    if (row.name != rows[*reference].name) {
      measure_errors(row, folder / row.name, rows[*reference], folder / rows[*reference].name);
    }
  }
  return rows[*reference].name;
}

} // namespace

int study_command(const StudyOptions& options, std::string& out) {
  std::vector<Variation> variations;
  for (const std::string& text : options.vary) {
    variations.push_back(parse_variation(text));
  }
  std::vector<StudyCase> cases;
  Variation named{"case", {}, {}};
  for (const std::string& text : options.cases) {
    cases.push_back(parse_case(text));
    named.values.push_back(cases.back().name);
  }
  if (variations.empty() && cases.empty()) {
    throw Error("study: nothing to vary\n  allowed: --vary key.path=value,value,... or --case \"NAME: key.path=value; ...\"");
  }
  std::vector<Job> jobs = jobs_of(options, cases, variations);
  const bool by_deck = options.reference != "finest" && options.reference != "exact" && std::none_of(jobs.begin(), jobs.end(), [&](const Job& job) {
    return names(options.reference, job.point.name, cases.empty() ? std::vector<std::string>{} : job.point.values);
  });
  if (by_deck) {
    StudyPoint reference{.name = "reference", .values = {}, .settings = {}, .deck = {}, .hash = deck_hash(read_scene(options.reference)), .cells = 0};
    jobs.push_back({std::move(reference), options.reference});
  }
  const fs::path folder = options.out.empty() ? fs::path("studies") / fs::path(options.deck).stem() : fs::path(options.out);
  out = folder.string();
  const int machine = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const int threads = options.threads > 0 ? options.threads : std::max(1, machine / options.jobs);
  fmt::print("{} runs in {}, {} at once, {} thread{} each\n", jobs.size(), out, options.jobs, threads, threads == 1 ? "" : "s");
  std::fflush(stdout);
  struct sigaction action{};
  action.sa_handler = on_stop;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  const bool finished = Runner(folder, options.jobs, threads).run(jobs);
  std::vector<StudyRow> rows;
  for (const Job& job : jobs) {
    const fs::path at = folder / job.point.name;
    rows.push_back(left_by_earlier(at, job.point.hash) == Left::done ? read_study_row(at) : StudyRow{});
    rows.back().name = job.point.name;
    rows.back().values = job.point.values;
  }
  const std::string reference = measure(options, folder, by_deck, rows);
  if (!cases.empty()) {
    variations.insert(variations.begin(), named);
  }
  write_study(folder, options, variations, rows, reference);
  const bool whole = std::all_of(rows.begin(), rows.end(), [](const StudyRow& row) { return row.ended == "finished" || row.ended == "failed"; });
  return static_cast<int>(!finished ? ExitStatus::interrupted : whole ? ExitStatus::finished : ExitStatus::numerical_failure);
}

} // namespace ballast
