#include "Schema.hpp"

namespace suture::study {
namespace {

Schema sweepsSchema() {
  Schema parameter("A parameter of the scene and its values.");
  parameter.text("Path", std::nullopt, "Path in the scene, as for --set: Mesh/Constants/scale. 'Scene' is the scene file itself.");
  parameter.texts("Values", std::nullopt,
                  "Values, as many as for the other parameters of the sweep. Write an array in its own braces: {{8, 8}, {16, 16}}; "
                  "'-' keeps the value of the scene.");
  Schema sweep("Parameters that vary together: first the first values of all, then the second values, ...");
  sweep.texts("Labels", std::vector<std::string>{}, "Names of the values in tables, bands and --only; default: the values themselves.");
  sweep.each("<parameter>", parameter, 1);
  return Schema("Parameters to vary, named by the user; all combinations of different sweeps are run.").each("<sweep>", sweep);
}

Schema bandsSchema() {
  Schema band("Condition on a column; exit code 4 if it is violated.");
  band.text("Column", std::nullopt, "A column, a path of summary.json, or a formula of them.");
  band.texts("Where", std::vector<std::string>{}, "Rows that count, as sweep=label or sweep=label|label; default: all.");
  band.real("At Most", std::nullopt, "Upper bound of every value.").optional();
  band.real("At Least", std::nullopt, "Lower bound of every value.").optional();
  band.real("Largest Over Smallest At Most", std::nullopt, "Bound of this ratio over all rows that count.", Range::atLeast(1.0)).optional();
  band.real("Largest Minus Smallest At Most", std::nullopt, "Bound of this difference over all rows that count.", Range::atLeast(0.0))
      .optional();
  return Schema("Conditions on the table, named by the user.").each("<band>", band);
}

Schema ordersSchema() {
  Schema order("The slope of log Y over log X, fitted by least squares; exit code 4 if it is outside its bounds.");
  order.text("X", "h", "A column, a path of summary.json, or a formula of them; h is elements^(-1 / dimension).");
  order.text("Y", std::nullopt, "An error: a column, a path of summary.json, or a formula of them.");
  order.texts("Where", std::vector<std::string>{}, "Rows that count, as sweep=label or sweep=label|label; default: all.");
  order.texts("By", std::vector<std::string>{}, "Sweeps: one fit per combination of their labels.");
  order.integer("Last", 0, "Number of runs that count, those with the smallest X, where the order shows; 0: all.", Range::atLeast(0));
  order.real("At Least", std::nullopt, "Lower bound of the order.").optional();
  order.real("At Most", std::nullopt, "Upper bound of the order.").optional();
  return Schema("Required orders of convergence, named by the user.").each("<order>", order);
}

Schema plotsSchema() {
  Schema plot("One plot, DIR/<name>.png.");
  plot.text("X", std::nullopt, "Column or sweep on the horizontal axis; labels that are not numbers are equally spaced.");
  plot.texts("Y", std::nullopt, "Columns, one panel per column.");
  plot.texts("By", std::vector<std::string>{}, "Sweeps, one line per combination of labels; rows with equal line and x are averaged.");
  plot.texts("Logarithmic", std::vector<std::string>{}, "Axes with a logarithmic scale: {X, Y}.");
  plot.boolean(
      "Pareto", false,
      "Mark the runs that no other run beats in both X and Y (less is better): a work-precision diagram, if the axes are error and time.");
  return Schema("Plots, named by the user.").each("<plot>", plot);
}

}  // namespace

Schema studySchema() {
  Schema study("A study: a scene, run with all combinations of values of some of its parameters, and a table of the results.");
  study.text("Title", "", "Printed, and written above the table; empty: the name of the file.");
  study.text("Scene", "", "Scene file, relative to this file; may be swept instead.");
  study.texts("Set", std::vector<std::string>{}, "Overrides of the scene in every run, as for --set: {Path/To/Parameter=value, ...}.");
  study.list("Sweeps", sweepsSchema());
  study.texts("Columns", std::vector<std::string>{},
              "Columns of the table: names (pcg, condition, ...), paths of summary.json with dots, or 'name = formula'. Empty: all "
              "predefined names.");
  study.list("Bands", bandsSchema());
  study.list("Orders", ordersSchema());
  study.list("Plots", plotsSchema());
  study.integer("Repetitions", 1, "Runs per combination; times are medians.", Range::atLeast(1));
  study.boolean("Fields", false, "Also write the fields of each run.");
  study.boolean("Allow Failures", false, "A run that does not converge or is refused is a row and does not fail the study.");
  return study;
}

}  // namespace suture::study
