// ballast study: one deck run over a grid of key values; cost and error of every run, side by side.
//
// Every point is a run of its own (a child process: a failure is a row, its memory and CPU time are its own), in a folder of
// its own, and is kept: a study that was interrupted goes on where it stopped.
#pragma once

#include "problems/commands.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace ballast {

/// --vary "KEY[+KEY...]=VALUE,VALUE,...": keys joined by + take the same value.
struct Variation {
  std::string name;               ///< as written before the =
  std::vector<std::string> keys;
  std::vector<std::string> values; ///< as --set takes them
};
/// Throws Error. Commas inside quotes, brackets and braces separate nothing.
Variation parse_variation(const std::string& text);

/// --case "NAME: deck=FILE; KEY=VALUE; ...". Throws Error.
struct StudyCase {
  std::string name, deck; ///< deck: empty, the study's
  std::vector<std::string> settings;
};
StudyCase parse_case(const std::string& text);

struct StudyPoint {
  std::string name;                  ///< folder: "03_mesh.refine=2"
  std::vector<std::string> values;   ///< by variation
  std::vector<std::string> settings; ///< for --set
  std::string deck;                  ///< empty: the study's
  std::string hash;                  ///< of the resolved deck
  std::size_t cells = 0;             ///< of its mesh, once the deck is read
};
/// All combinations, the last variation fastest. Throws Error if a key is varied twice.
std::vector<StudyPoint> study_points(const std::vector<Variation>& variations, const std::vector<std::string>& settings);
/// Those of every case, one after the other; the case's name is the first value.
std::vector<StudyPoint> study_points(const std::vector<StudyCase>& cases, const std::vector<Variation>& variations, const std::vector<std::string>& settings);

/// What a run cost and gave.
struct StudyRow {
  std::string name;
  std::vector<std::string> values;
  std::string ended;   ///< finished, failed; empty: not run
  std::string message; ///< of a failure
  double wall = 0, cpu = 0, peak_memory = 0; ///< s, s, byte
  double cells = 0, steps = 0, rate = 0;     ///< rate: cell-steps a second
  std::map<std::string, double> results;     ///< summary.json's results, flat: "bullet.velocity_m_per_s"
  std::map<std::string, double> errors;      ///< relative, against the reference
};

/// Reads what a run left in its folder; nothing there gives an empty row.
StudyRow read_study_row(const std::filesystem::path& folder);

/// Errors of `row` against `reference`: of every result both have, |x - x_ref| / |x_ref|; of the histories' columns that
/// results come from, "L1 NAME" and "Linf NAME": mean and largest |x - x_ref| over the time both cover, by the largest |x_ref|.
void measure_errors(StudyRow& row, const std::filesystem::path& folder, const StudyRow& reference, const std::filesystem::path& reference_folder);

/// Errors of `row` against the exact solution, as its run measured them: "L1 density", ...
void take_exact_errors(StudyRow& row);

/// Throws Error where several runs have the most cells: which of them is right is not for the order of the command line to say.
void require_one_finest(const std::vector<StudyPoint>& points);

/// Makes `folder` this program's for a new run. What an earlier one said goes first: a run that is killed leaves no other build's
/// answer under this one's name.
void claim_folder(const std::filesystem::path& folder);

/// Writes study.csv, study.md and study.json (what `ballast report` draws) into `folder`.
void write_study(const std::filesystem::path& folder, const StudyOptions& options, const std::vector<Variation>& variations,
                 const std::vector<StudyRow>& rows, const std::string& reference);

} // namespace ballast
