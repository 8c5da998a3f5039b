// The program `ballast`: reads the command line, calls a command, turns what it throws into an exit
// status.
#include "core/threads.hpp"
#include "core/error.hpp"
#include "core/fp_traps.hpp"
#include "post/report.hpp"
#include "post/study_pictures.hpp"
#include "problems/commands.hpp"
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>

namespace {

using ballast::ExitStatus;

int status(ExitStatus s) {
  return static_cast<int>(s);
}

/// Adds a subcommand whose function's result becomes the exit status.
CLI::App*
word(CLI::App& app, const char* name, const char* help, int& result, std::function<int()> run) {
  CLI::App* sub = app.add_subcommand(name, help);
  sub->callback([&result, run = std::move(run)] { result = run(); });
  return sub;
}

int dispatch(int argc, char** argv) {
  CLI::App app{"Ballast: ALE multi-material impact code", "ballast"};
  app.set_version_flag("--version", std::string("ballast ") + ballast::version);
  app.require_subcommand(1);
  int result = 0;

  ballast::RunOptions run;
  run.exact = ballast::exact_solution_of;
  CLI::App* sub = word(app, "run", "run a deck", result, [&] { return ballast::run_command(run); });
  sub->add_option("deck", run.deck, "the deck, DECK.toml")->required();
  sub->add_option("--out", run.out, "run directory");
  sub->add_option(
         "--set", run.settings, "key.path=value, instead of what the deck says; may be repeated")
      ->expected(1)
      ->take_all();
  sub->add_option("--threads", run.threads, "threads; default all")->check(CLI::Range(1, 4096));
  sub->add_option("--restart", run.restart, "checkpoint to go on from");

  ballast::CheckOptions check;
  sub = word(app, "check", "validate a deck and say what it costs", result, [&] {
    return ballast::check_command(check);
  });
  sub->add_option("deck", check.deck, "the deck, DECK.toml")->required();
  sub->add_option("--set", check.settings, "key.path=value; may be repeated")
      ->expected(1)
      ->take_all();

  ballast::VerifyOptions verify;
  sub = word(app, "verify", "run verification cases", result, [&] {
    return ballast::verify_command(verify);
  });
  auto* names = sub->add_option("name", verify.names, "cases; default all but the long ones that --list marks");
  sub->add_flag("--all", verify.all, "the long ones, too")->excludes(names);
  sub->add_flag("--hard", verify.hard, "every case at CFL 0.3, 0.5, 0.8, remapped every 1 and 4 steps, with every closure: what ends");
  sub->add_flag("--list", verify.list, "only name the cases, all of them");
  sub->add_option("--threads", verify.threads, "threads; default all")->check(CLI::Range(1, 4096));

  ballast::StudyOptions study;
  study.exact = ballast::exact_solution_of;
  sub = word(app, "study", "run a deck over a grid of key values: cost and error of each", result, [&] {
    std::string folder;
    const int code = ballast::study_command(study, folder);
    std::cout << "tables: " << folder << "/study.csv, study.md\n";
    ballast::post::draw_study(folder, std::cout);
    return code;
  });
  sub->add_option("deck", study.deck, "the deck, DECK.toml")->required();
  sub->add_option("--vary", study.vary, "key.path=value,value,...; keys joined by + vary together; may be repeated: all combinations")
      ->expected(1)
      ->take_all();
  sub->add_option("--case", study.cases, "\"NAME: deck=FILE; key.path=value; ...\": runs that differ in more than a key; deck and keys may be left out; with --vary: all combinations")
      ->expected(1)
      ->take_all();
  sub->add_option("--set", study.settings, "key.path=value, for all runs; may be repeated")->expected(1)->take_all();
  sub->add_option("--reference", study.reference, "what errors are against: finest (the run that alone has the most cells), exact (known for Riemann problems and plate impact), a case or a run by its name, or a deck, REFERENCE.toml");
  sub->add_option("--out", study.out, "folder of the study; what it holds of these runs is kept");
  sub->add_option("--jobs", study.jobs, "runs at once")->check(CLI::Range(1, 4096));
  sub->add_option("--threads", study.threads, "threads of each run; default: the machine's shared by the jobs")->check(CLI::Range(1, 4096));

  std::string dir, view;
  sub = word(app, "report", "pictures and a page of a run directory", result, [&] {
    if (ballast::post::is_study(dir)) {
      ballast::post::draw_study(dir, std::cout);
    } else {
      ballast::post::report(dir, std::cout, view);
    }
    return status(ExitStatus::finished);
  });
  sub->add_option("dir", dir, "run directory")->required();
  sub->add_option("--view", view, "what the close-ups show: \"-8 mm, 8 mm, 0 mm, 30 mm\" (first axis, second axis)");

  std::string material;
  sub = word(app, "materials", "named materials and their sources", result, [&] {
    return ballast::materials_command(material);
  });
  sub->add_option("name", material);

  word(app, "deck-reference", "", result, ballast::deck_reference_command)->group("");
  word(app, "injury-reference", "", result, ballast::injury_reference_command)->group("");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : status(ExitStatus::bad_input);
  }
  return result;
}

} // namespace

int main(int argc, char** argv) {
  ballast::trap_floating_point_errors();
  ballast::keep_freed_memory();
  try {
    return dispatch(argc, argv);
  } catch (const ballast::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return status(ExitStatus::bad_input);
  } catch (const ballast::NumericalFailure& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return status(ExitStatus::numerical_failure);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ballast: %s\n", error.what());
    return status(ExitStatus::numerical_failure);
  }
}
