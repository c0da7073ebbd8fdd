#pragma once
#include <suture/base/Errors.hpp>
#include <suture/base/scene/Schema.hpp>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <type_traits>

namespace suture {

/// Maker of the strategies of one kind: takes the parameters of the strategy's own sublist. A kind that needs further arguments
/// before them defines `Base::Maker`.
template <typename Base, typename = void>
struct MakerOf {
  using Type = std::function<std::unique_ptr<Base>(const Parameters&)>;
};
template <typename Base>
struct MakerOf<Base, std::void_t<typename Base::Maker>> {
  using Type = typename Base::Maker;
};

/// Open table of the strategies of one kind: name -> maker and schema of the strategy's parameters. A user's shared library adds a strategy
/// by a static object:
///     static const suture::Registration<suture::Weighting> mine("Mine", schema, [](const Parameters& p) { return ...; });
/// `Base::kind()` names the kind in messages ("weighting"). Built-in strategies are added by `registerBuiltIns` of their package, which
/// the table calls at its first use, so no linker drops them.
template <typename Base>
class Registry {
 public:
  using Maker = typename MakerOf<Base>::Type;

  static Registry& instance() {
    static Registry registry;
    static const bool filled = (registerBuiltIns(registry), true);
    (void)filled;
    return registry;
  }

  /// \param schema  of the strategy's parameters; a function, because they may name strategies that are registered later.
  /// \throws InternalError  if the name is taken
  void add(const std::string& name, std::function<Schema()> schema, Maker maker) {
    if (!entries_.emplace(name, Entry{std::move(schema), std::move(maker)}).second)
      throw InternalError(std::string("two strategies of the kind '") + Base::kind() + "' are named '" + name + "'");
  }
  void add(const std::string& name, const Schema& schema, Maker maker) {
    add(
        name, [schema] { return schema; }, std::move(maker));
  }

  bool has(const std::string& name) const { return entries_.count(name) > 0; }

  /// \param inputs  arguments of the maker; the last is the strategy's own sublist
  /// \throws InputError  for an unknown name, with the nearest and all known names.
  template <typename... Inputs>
  std::unique_ptr<Base> make(const std::string& name, const Inputs&... inputs) const {
    const auto found = entries_.find(name);
    if (found == entries_.end()) throw InputError(Base::kind(), unknownName(Base::kind(), name, names()));
    return found->second.maker(inputs...);
  }

  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& entry : entries_) all.push_back(entry.first);
    return all;
  }

  /// name -> schema, as Schema::choice takes it.
  std::map<std::string, Schema> schemas() const {
    std::map<std::string, Schema> all;
    for (const auto& [name, entry] : entries_) all.emplace(name, entry.schema());
    return all;
  }

 private:
  struct Entry {
    std::function<Schema()> schema;
    Maker maker;
  };
  // Found by argument-dependent lookup in the package of Base: void registerBuiltIns(Registry<Base>&).
  std::map<std::string, Entry> entries_;
};

/// Makes the strategy that a resolved list names: the value of `parameter`, with the sublist of that name as its parameters.
template <typename Base, typename List = Parameters, typename... Inputs>
std::unique_ptr<Base> makeStrategy(const List& list, const std::string& parameter, const Inputs&... inputs) {
  const auto name = list.template get<std::string>(parameter);
  return Registry<Base>::instance().make(name, inputs..., list.isSublist(name) ? list.sublist(name) : List());
}

/// Registers a strategy when the program or a plugin is loaded.
template <typename Base>
struct Registration {
  Registration(const std::string& name, const Schema& schema, typename Registry<Base>::Maker maker) {
    Registry<Base>::instance().add(name, schema, std::move(maker));
  }
  /// \param schema  called when it is needed: it may name strategies that are registered later
  Registration(const std::string& name, std::function<Schema()> schema, typename Registry<Base>::Maker maker) {
    Registry<Base>::instance().add(name, std::move(schema), std::move(maker));
  }
};

}  // namespace suture
