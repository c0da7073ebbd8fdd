#include "Table.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <suture/base/Numbers.hpp>
#include <suture/report/Format.hpp>

namespace suture::study {
namespace {

using Json = nlohmann::ordered_json;

bool hasFailures(const std::vector<Row>& rows) {
  return std::any_of(rows.begin(), rows.end(), [](const Row& row) { return !row.failure.empty(); });
}

// Labels, then cells; each formatted by `write`.
template <typename Write>
std::vector<std::string> fields(const Study& study, const Row& row, bool failures, const Write& write) {
  std::vector<std::string> all;
  for (std::size_t s = 0; s < study.sweeps.size(); ++s) all.push_back(study.sweeps[s].labels[row.run->choice[s]]);
  for (const TableCell& cell : row.cells) all.push_back(write(cell));
  if (failures) all.push_back(row.failure);
  return all;
}

std::vector<std::string> header(const Study& study, bool failures) {
  std::vector<std::string> names;
  for (const Sweep& sweep : study.sweeps) names.push_back(sweep.name);
  for (const Column& column : study.columns) names.push_back(column.name);
  if (failures) names.push_back("failure");
  return names;
}

std::string joined(const std::vector<std::string>& fields, const std::string& separator) {
  std::string line;
  for (std::size_t i = 0; i < fields.size(); ++i) line += (i > 0 ? separator : "") + fields[i];
  return line;
}

// RFC 4180.
std::string quoted(const std::string& field) {
  if (field.find_first_of(",\"\n") == std::string::npos) return field;
  std::string text = "\"";
  for (const char c : field) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + "\"";
}

std::string piped(std::string field) {
  for (std::size_t at = field.find('|'); at != std::string::npos; at = field.find('|', at + 2)) field.insert(at, "\\");
  return field;
}

template <typename Escape>
std::vector<std::string> escaped(std::vector<std::string> fields, const Escape& escape) {
  for (std::string& field : fields) field = escape(field);
  return fields;
}

bool isTime(const std::string& path) {
  const std::string unit = "seconds";
  return path.rfind("/phases/", 0) == 0 || (path.size() > unit.size() && path.compare(path.size() - unit.size(), unit.size(), unit) == 0);
}

// The median; for an even number of values the lower of the middle two, which is a measured time.
double median(std::vector<double> values) {
  const auto middle = values.begin() + (values.size() - 1) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Json withMedians(const std::vector<std::string>& summaries) {
  std::vector<Json> flat;
  for (const std::string& text : summaries) flat.push_back(Json::parse(text).flatten());
  Json first = Json::parse(summaries.front());
  for (const auto& [path, value] : flat.front().items()) {
    if (!isTime(path) || !value.is_number()) continue;
    std::vector<double> values;
    for (const Json& one : flat)
      if (one.contains(path) && one[path].is_number()) values.push_back(one[path].get<double>());
    first[Json::json_pointer(path)] = median(values);
  }
  return first;
}

}  // namespace

Row studyRow(const Study& study, const Combination& run, const std::vector<std::string>& summaries, int exitCode,
             const std::string& failure) {
  Row row{&run, {}, {}, {}, exitCode, failure};
  std::replace(row.failure.begin(), row.failure.end(), '\n', ' ');
  Json summary = summaries.empty() ? Json::object() : withMedians(summaries);
  summary["exit_code"] = exitCode;
  for (const Column& column : study.columns) row.cells.push_back(column.formula.evaluate(summary));
  for (const Band& band : study.bands) {
    // Figures of a run that did not converge are meaningless, except the exit code and convergence.
    const std::vector<std::string> paths = band.formula.paths();
    const bool counts = exitCode == 0 || paths == std::vector<std::string>{"exit_code"} || paths == std::vector<std::string>{"converged"};
    row.judged.push_back(counts ? band.formula.evaluate(summary) : TableCell());
  }
  for (const Order& order : study.orders)
    row.ordered.push_back(exitCode == 0 ? std::make_pair(order.xFormula.evaluate(summary), order.yFormula.evaluate(summary))
                                        : std::make_pair(TableCell(), TableCell()));
  return row;
}

std::string shown(const TableCell& cell) {
  if (cell.kind == TableCell::Kind::Integer) return grouped(static_cast<long long>(cell.number));
  if (cell.kind == TableCell::Kind::Real) return format("%.4g", cell.number);
  return cell.text;
}

std::string exact(const TableCell& cell) {
  if (cell.kind == TableCell::Kind::Integer) return std::to_string(static_cast<long long>(cell.number));
  return cell.kind == TableCell::Kind::Real ? realText(cell.number) : cell.text;
}

std::string tableCsv(const Study& study, const std::vector<Row>& rows) {
  const bool failures = hasFailures(rows);
  std::string text = joined(escaped(header(study, failures), quoted), ",") + "\n";
  for (const Row& row : rows) text += joined(escaped(fields(study, row, failures, exact), quoted), ",") + "\n";
  return text;
}

std::string tableMarkdown(const Study& study, const std::vector<Row>& rows) {
  const bool failures = hasFailures(rows);
  const std::vector<std::string> names = escaped(header(study, failures), piped);
  std::string text = "| " + joined(names, " | ") + " |\n|";
  for (std::size_t i = 0; i < names.size(); ++i) text += "---|";
  text += "\n";
  for (const Row& row : rows) text += "| " + joined(escaped(fields(study, row, failures, shown), piped), " | ") + " |\n";
  return text;
}

std::string tableJson(const Study& study, const std::vector<Row>& rows) {
  Json all{
      {"title", study.title}, {"sweeps", Json::array()}, {"columns", Json::array()}, {"rows", Json::array()}, {"plots", Json::array()}};
  for (const Sweep& sweep : study.sweeps) all["sweeps"].push_back({{"name", sweep.name}, {"labels", sweep.labels}});
  for (const Column& column : study.columns) all["columns"].push_back(column.name);
  for (const Row& row : rows) {
    Json labels = Json::array(), cells = Json::array();
    for (std::size_t s = 0; s < study.sweeps.size(); ++s) labels.push_back(study.sweeps[s].labels[row.run->choice[s]]);
    for (const TableCell& cell : row.cells)
      cells.push_back(cell.isNumber() ? Json(cell.number) : cell.kind == TableCell::Kind::Text ? Json(cell.text) : Json());
    all["rows"].push_back({{"labels", labels}, {"cells", cells}, {"exit_code", row.exitCode}, {"failure", row.failure}});
  }
  for (const Plot& plot : study.plots)
    all["plots"].push_back({{"name", plot.name},
                            {"x", plot.x},
                            {"y", plot.y},
                            {"by", plot.by},
                            {"logarithmic_x", plot.logarithmicX},
                            {"logarithmic_y", plot.logarithmicY},
                            {"pareto", plot.pareto}});
  return all.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace suture::study
