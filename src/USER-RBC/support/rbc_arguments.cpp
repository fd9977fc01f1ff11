#include "support/rbc_arguments.h"

#include "utils.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

Arguments::Arguments(LAMMPS *lmp, std::string style, int narg, char **arg, int first) :
    Pointers(lmp), style_(std::move(style)), narg_(narg), arg_(arg), next_(first)
{
  if (narg < first) utils::missing_cmd_args(FLERR, style_, error);
}

std::string Arguments::style() const
{
  std::string style = style_;
  style[0] = static_cast<char>(std::toupper(style[0]));
  return style;
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
  return !at_end() && utils::is_double(arg_[next_]);
}

/* ---------------------------------------------------------------------- */

std::string Arguments::text()
{
  if (at_end())
    utils::missing_cmd_args(FLERR, keyword_.empty() ? style_ : style_ + ' ' + keyword_, error);
  return arg_[next_++];
}

double Arguments::number()
{
  const std::string word = text();
  const double value = utils::numeric(FLERR, word, false, lmp);
  if (!std::isfinite(value)) refuse(keyword_, "a finite number");
  return value;
}

double Arguments::positive(const std::string &name)
{
  const double value = number();
  if (!(value > 0)) refuse(named(name), "> 0");
  return value;
}

double Arguments::not_negative(const std::string &name)
{
  const double value = number();
  if (!(value >= 0)) refuse(named(name), ">= 0");
  return value;
}

double Arguments::between(double low, double high, const std::string &name)
{
  const double value = number();
  if (!(value > low && value < high))
    refuse(named(name), fmt::format("between {:g} and {:g}", low, high));
  return value;
}

int Arguments::whole(int least, int most, const std::string &name)
{
  const std::string word = text();
  const int value = utils::inumeric(FLERR, word, false, lmp);
  if (value >= least && value <= most) return value;
  if (most == MAXSMALLINT)
    refuse(named(name), least == 1 ? "> 0" : fmt::format("at least {}", least));
  if (most == least + 1) refuse(named(name), fmt::format("{} or {}", least, most));
  refuse(named(name), fmt::format("between {} and {}", least, most));
}

bool Arguments::logical()
{
  const std::string word = text();
  return utils::logical(FLERR, word, false, lmp) == 1;
}

NumberOrVariable Arguments::number_or_variable()
{
  const std::string word = text();
  return NumberOrVariable(lmp, word.c_str());
}

std::array<NumberOrVariable, 3> Arguments::vector()
{
  std::array<NumberOrVariable, 3> components;
  for (NumberOrVariable &component : components) component = number_or_variable();
  return components;
}

/* ---------------------------------------------------------------------- */

void Arguments::stop(const std::string &message)
{
  error->all(FLERR, last(), "{}", message);
  std::abort();    // not reached
}

void Arguments::refuse(const std::string &name, const std::string &range)
{
  const std::string what = name.empty() ? "" : name + ' ';
  fail("{} {}value {} must be {}", style(), what, arg_[last()], range);
}

void Arguments::unknown(const std::string &what, const std::string &word,
                        const std::vector<std::string> &allowed)
{
  fail("Unknown {} {} {}; allowed: {}", style_, what, word, utils::join_words(allowed, ", "));
}
