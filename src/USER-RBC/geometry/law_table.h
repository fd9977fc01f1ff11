#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace rbc {

/// What the values of a law's parameter may be.
enum class Bound { positive, not_negative };

/// A parameter of a law as users give it.
struct LawParameter {
  const char *name;
  Bound bound;
  bool is_length = false;    ///< may be given in another unit than that of the input
};

/// Lists of laws. A std::variant of laws is their table: readers of input find a law in it by its
/// word. Each law has
///   static constexpr const char *name           its word in input scripts,
///   static constexpr std::array parameters      of LawParameter, in the order of the input,
///   a constructor                               from as many numbers, in the same order.
namespace law_table {

/// A type as a value, so that functions can be called for a law that has no object yet.
template <typename Law> struct Type {
  using type = Law;
};

/// Calls f(Type<Law>, index) for each law of the table, in its order.
template <typename Function, typename... Laws>
void visit_all(Type<std::variant<Laws...>>, const Function &f)
{
  std::size_t index = 0;
  (f(Type<Laws>(), index++), ...);
}

template <typename Law, std::size_t... n> Law make(const double *values, std::index_sequence<n...>)
{
  return Law(values[n]...);
}

}    // namespace law_table

/// The words of all laws of a table, separated by commas: what an error message says is allowed.
template <typename Table> std::string law_names()
{
  std::string names;
  law_table::visit_all(law_table::Type<Table>(), [&](auto type, std::size_t index) {
    names += (index > 0 ? ", " : "") + std::string(decltype(type)::type::name);
  });
  return names;
}

/// Place of the law with that word in the table; the number of laws if there is none.
template <typename Table> std::size_t law_index(const std::string &word)
{
  std::size_t found = std::variant_size_v<Table>;
  law_table::visit_all(law_table::Type<Table>(), [&](auto type, std::size_t index) {
    if (word == decltype(type)::type::name) found = index;
  });
  return found;
}

/// Parameters of the law at that place of the table, in the order of the input.
template <typename Table> std::vector<LawParameter> law_parameters(std::size_t law)
{
  std::vector<LawParameter> found;
  law_table::visit_all(law_table::Type<Table>(), [&](auto type, std::size_t index) {
    const auto &parameters = decltype(type)::type::parameters;
    if (index == law) found.assign(parameters.begin(), parameters.end());
  });
  return found;
}

/// Names of the parameters that any law of the table has, each once, in order of appearance.
template <typename Table> std::vector<std::string> parameter_names()
{
  std::vector<std::string> names;
  for (std::size_t law = 0; law < std::variant_size_v<Table>; ++law)
    for (const LawParameter &parameter : law_parameters<Table>(law))
      if (std::find(names.begin(), names.end(), parameter.name) == names.end())
        names.emplace_back(parameter.name);
  return names;
}

/// The law at that place of the table, made from its parameters. Throws std::bad_variant_access if
/// there is none.
template <typename Table> Table make_law(std::size_t law, const std::vector<double> &values)
{
  std::vector<Table> made;
  law_table::visit_all(law_table::Type<Table>(), [&](auto type, std::size_t index) {
    using Law = typename decltype(type)::type;
    using Places = std::make_index_sequence<std::tuple_size_v<decltype(Law::parameters)>>;
    if (index == law) made.push_back(law_table::make<Law>(values.data(), Places()));
  });
  if (made.empty()) throw std::bad_variant_access();
  return made[0];
}

}    // namespace rbc
