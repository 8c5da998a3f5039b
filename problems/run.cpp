// ballast run and ballast verify.
#include "core/error.hpp"
#include "problems/commands.hpp"
#include "problems/run_session.hpp"
#include "problems/scene_report.hpp"
#include "problems/verify.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <thread>

namespace ballast {

int run_command(const RunOptions& options) {
  const ReadScene read = read_scene(options.deck, options.settings);
  if (!options.restart.empty() && !std::filesystem::exists(options.restart)) {
    throw Error(fmt::format("--restart {}: no such file", options.restart));
  }
  const std::filesystem::path dir =
      options.out.empty() ? std::filesystem::path("runs") / std::filesystem::path(options.deck).stem() : std::filesystem::path(options.out);
  const int threads = options.threads > 0 ? options.threads : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  fmt::print("{}", scene_table(read.scene));
  fmt::print("run directory {}, {} thread{}\n", dir.string(), threads, threads == 1 ? "" : "s");
  if (read.scene.geometry == Geometry::three_d) {
    return RunSession<3>(read, dir, threads, options.restart, options.exact).run();
  }
  return RunSession<2>(read, dir, threads, options.restart, options.exact).run();
}

int verify_command(const VerifyOptions& options) {
  if (options.list) {
    for (const VerifyCase& c : verification_cases()) {
      fmt::print("{:<20} {}{}\n", c.name, c.law, c.by_name ? " (by name or --all)" : ""); // cmake/DiscoverVerify.cmake reads it
    }
    return 0;
  }
  const int failed = options.hard ? run_hard_verification(options.names, options.all) : run_verification(options.names, options.all);
  return failed == 0 ? 0 : 1;
}

} // namespace ballast
