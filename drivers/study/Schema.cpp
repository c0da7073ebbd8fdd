#include "Schema.hpp"

namespace suture::study {
namespace {

Schema sweepsSchema() {
  Schema parameter("A parameter of the scene and its values.");
  parameter.text("Path", std::nullopt,
                 "Where it stands in the scene, as behind --set: Mesh/Constants/scale. 'Scene' is the scene file itself.");
  parameter.texts(
      "Values", std::nullopt,
      "Its values, as many as the other parameters of the sweep have. An array is written in braces of its own: {{8, 8}, {16, 16}}; "
      "a '-' leaves the parameter as the scene has it.");
  Schema sweep("Parameters that vary together: the first values of all, then the second ones, ...");
  sweep.texts("Labels", std::vector<std::string>{},
              "How the values are called in tables, bands and --only; by default the values themselves.");
  sweep.each("<parameter>", parameter, 1);
  return Schema("Parameters that are varied, named by the user; all combinations of different sweeps are run.").each("<sweep>", sweep);
}

Schema bandsSchema() {
  Schema band("Condition on a column; if it is missed, the exit code is 4.");
  band.text("Column", std::nullopt, "A column, a path of summary.json, or a formula of them.");
  band.texts("Where", std::vector<std::string>{}, "Rows that count, as sweep=label or sweep=label|label; by default all.");
  band.real("At Most", std::nullopt, "Every value.").optional();
  band.real("At Least", std::nullopt, "Every value.").optional();
  band.real("Largest Over Smallest At Most", std::nullopt, "Bound of this ratio of the values of all rows that count.", Range::atLeast(1.0))
      .optional();
  band.real("Largest Minus Smallest At Most", std::nullopt, "Bound of this difference of the values of all rows that count.",
            Range::atLeast(0.0))
      .optional();
  return Schema("Conditions that the table must fulfil, named by the user.").each("<band>", band);
}

Schema ordersSchema() {
  Schema order("The slope of log Y over log X, fitted by least squares; missed: exit code 4.");
  order.text("X", "h", "A column, a path of summary.json, or a formula of them; h is elements^(-1 / dimension).");
  order.text("Y", std::nullopt, "An error: a column, a path of summary.json, or a formula of them.");
  order.texts("Where", std::vector<std::string>{}, "Rows that count, as sweep=label or sweep=label|label; by default all.");
  order.texts("By", std::vector<std::string>{}, "Sweeps: each combination of their labels is fitted by itself.");
  order.integer("Last", 0, "Only so many runs of smallest X count, where the order shows; 0: all.", Range::atLeast(0));
  order.real("At Least", std::nullopt, "The order.").optional();
  order.real("At Most", std::nullopt, "The order.").optional();
  return Schema("Orders of convergence that the table must show, named by the user.").each("<order>", order);
}

Schema plotsSchema() {
  Schema plot("One picture, DIR/<name>.png.");
  plot.text("X", std::nullopt, "Column or sweep along the horizontal axis; labels that are no numbers are put side by side.");
  plot.texts("Y", std::nullopt, "Columns, a panel each.");
  plot.texts("By", std::vector<std::string>{},
             "Sweeps with a line for each combination of labels; rows that share line and x are averaged.");
  plot.texts("Logarithmic", std::vector<std::string>{}, "Axes with a logarithmic scale: {X, Y}.");
  plot.boolean(
      "Pareto", false,
      "Mark the runs that no other beats in X and in Y (less is better): a work-precision diagram, with error and time on the axes.");
  return Schema("Pictures, named by the user.").each("<plot>", plot);
}

}  // namespace

Schema studySchema() {
  Schema study("A study: a scene, run with all combinations of values of some of its parameters; a table of what came out.");
  study.text("Title", "", "Printed and written above the table; empty: the name of the file.");
  study.text("Scene", "", "Scene file, relative to this file; it may be swept instead.");
  study.texts("Set", std::vector<std::string>{}, "Changes of the scene in every run, as behind --set: {Path/To/Parameter=value, ...}.");
  study.list("Sweeps", sweepsSchema());
  study.texts("Columns", std::vector<std::string>{},
              "Columns of the table: names (pcg, condition, ...), paths of summary.json with dots, or 'name = formula'. Empty: all that "
              "have a name.");
  study.list("Bands", bandsSchema());
  study.list("Orders", ordersSchema());
  study.list("Plots", plotsSchema());
  study.integer("Repetitions", 1, "Runs of each combination; of all times the median is kept.", Range::atLeast(1));
  study.boolean("Fields", false, "Write the fields of each run, too.");
  study.boolean("Allow Failures", false, "A run that does not converge or is refused is a row, not a missed study.");
  return study;
}

}  // namespace suture::study
