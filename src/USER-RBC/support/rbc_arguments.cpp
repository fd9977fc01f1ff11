#include "support/rbc_arguments.h"

#include "atom.h"
#include "error.h"
#include "input.h"
#include "label_map.h"
#include "utils.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

using namespace LAMMPS_NS;

namespace {

/// The word with those characters replaced that utils::numeric() replaces, too.
std::string as_ascii(const std::string &word)
{
  return utils::has_utf8(word) ? utils::utf8_subst(word) : word;
}

bool is_finite_number(const std::string &word)
{
  return utils::is_double(word) && std::isfinite(std::strtod(word.c_str(), nullptr));
}

/// What LAMMPS of 2025 has as LabelMap::find() is find_type() in that of 2026.
template <class Map>
auto type_with_label(const Map &map, const std::string &label, int)
    -> decltype(map.find_type(label, Atom::ATOM))
{
  return map.find_type(label, Atom::ATOM);
}

template <class Map>
auto type_with_label(const Map &map, const std::string &label, long)
    -> decltype(map.find(label, Atom::ATOM))
{
  return map.find(label, Atom::ATOM);
}

std::string range_of_integers(int least, int most)
{
  if (most == MAXSMALLINT) return least == 1 ? "> 0" : fmt::format("at least {}", least);
  if (most == least + 1) return fmt::format("{} or {}", least, most);
  return fmt::format("between {} and {}", least, most);
}

}    // namespace

/* ---------------------------------------------------------------------- */

Arguments::Arguments(LAMMPS *lmp, std::string style, int narg, char **arg, int first) :
    Pointers(lmp), style_(std::move(style)), narg_(narg), arg_(arg), next_(first)
{
  if (narg < first) utils::missing_cmd_args(FLERR, style_, error);
}

/* ---------------------------------------------------------------------- */

void Arguments::read(const std::vector<Keyword> &keywords)
{
  if (read_known(keywords) == narg_) return;
  std::vector<std::string> words;
  for (const Keyword &keyword : keywords) words.push_back(keyword.word);
  const std::string word = text();
  unknown("keyword", word, words);
}

int Arguments::read_known(const std::vector<Keyword> &keywords)
{
  while (!at_end()) {
    const std::string word = arg_[next_];
    const auto found = std::find_if(keywords.begin(), keywords.end(),
                                    [&](const Keyword &keyword) { return keyword.word == word; });
    if (found == keywords.end()) break;
    keyword_ = word;
    ++next_;
    found->read();
  }
  keyword_.clear();
  return next_;
}

/* ---------------------------------------------------------------------- */

bool Arguments::take(const std::string &word)
{
  if (at_end() || word != arg_[next_]) return false;
  ++next_;
  return true;
}

bool Arguments::next_is_number() const
{
  return !at_end() && utils::is_double(as_ascii(arg_[next_]));
}

/* ---------------------------------------------------------------------- */

std::string Arguments::text()
{
  if (at_end())
    utils::missing_cmd_args(FLERR, keyword_.empty() ? style_ : style_ + ' ' + keyword_, error);
  return arg_[next_++];
}

double Arguments::number(const std::string &name)
{
  const std::string value = text();
  if (!is_finite_number(as_ascii(value)))
    refuse(named(name), '\'' + value + '\'', "a finite number");
  return utils::numeric(FLERR, value, false, lmp);
}

double Arguments::positive(const std::string &name)
{
  const double value = number(name);
  if (!(value > 0)) refuse(named(name), word(), "> 0");
  return value;
}

double Arguments::not_negative(const std::string &name)
{
  const double value = number(name);
  if (!(value >= 0)) refuse(named(name), word(), ">= 0");
  return value;
}

double Arguments::between(double low, double high, const std::string &name)
{
  const double value = number(name);
  if (!(value > low && value < high))
    refuse(named(name), word(), fmt::format("between {:g} and {:g}", low, high));
  return value;
}

int Arguments::whole(int least, int most, const std::string &name)
{
  const std::string typed = text();
  const std::string digits = as_ascii(typed);
  if (!utils::is_integer(digits))
    refuse(named(name), '\'' + typed + '\'', "an integer " + range_of_integers(least, most));
  const long long value = std::strtoll(digits.c_str(), nullptr, 10);
  if (value > MAXSMALLINT)
    refuse(named(name), typed, fmt::format("between {} and {}", least, most));
  if (value < least || value > most) refuse(named(name), typed, range_of_integers(least, most));
  return static_cast<int>(value);
}

int Arguments::atom_type(const std::string &name)
{
  if (at_end() || !atom->labelmapflag || utils::is_integer(as_ascii(arg_[next_])))
    return whole(1, atom->ntypes, name);
  const std::string label = text();
  const int type = type_with_label(*atom->lmap, label, 0);
  if (type < 1)
    refuse(named(name), '\'' + label + '\'',
           fmt::format("a type label or an integer {}", range_of_integers(1, atom->ntypes)));
  return type;
}

bool Arguments::logical()
{
  const std::string word = text();
  return utils::logical(FLERR, word, false, lmp) == 1;
}

NumberOrVariable Arguments::number_or_variable()
{
  const std::string value = text();
  if (!utils::strmatch(value, "^v_") && !is_finite_number(as_ascii(value)))
    refuse(keyword_, '\'' + value + '\'', "a finite number or a variable v_name");
  return NumberOrVariable(lmp, value.c_str());
}

std::array<NumberOrVariable, 3> Arguments::vector()
{
  std::array<NumberOrVariable, 3> components;
  for (NumberOrVariable &component : components) component = number_or_variable();
  return components;
}

/* ---------------------------------------------------------------------- */

std::string Arguments::sentence_start() const
{
  std::string style = style_;
  style[0] = static_cast<char>(std::toupper(style[0]));
  return style;
}

/* ----------------------------------------------------------------------
   A style may be given a part of the arguments of the line, as pair styles are, or others than
   those of the line. The error class wants an index of the line, and trusts it.
------------------------------------------------------------------------- */

int Arguments::place_in_line() const
{
  if (next_ == 0) return Error::NOPOINTER;
  for (int i = 0; i < input->narg; ++i)
    if (input->arg + i == arg_ + next_ - 1) return i;
  return Error::NOPOINTER;
}

void Arguments::stop(const std::string &message)
{
  error->all(FLERR, place_in_line(), "{}", message);
}

void Arguments::refuse(const std::string &name, const std::string &value, const std::string &range)
{
  const std::string what = name.empty() ? "" : name + ' ';
  stop(fmt::format("{} {}value {} must be {}", sentence_start(), what, value, range));
}

void Arguments::unknown(const std::string &what, const std::string &word,
                        const std::vector<std::string> &allowed)
{
  stop(fmt::format("Unknown {} {} {}; allowed: {}", style_, what, word,
                   utils::join_words(allowed, ", ")));
}
