#ifndef LMP_RBC_ARGUMENTS_H
#define LMP_RBC_ARGUMENTS_H

#include "error.h"
#include "pointers.h"
#include "support/rbc_number_or_variable.h"

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

/// The arguments of a style, read one after the other. What is wrong is an error of LAMMPS that
/// points at the argument and names style, keyword, value and what is allowed.
class Arguments : protected Pointers {
 public:
  /// A word that begins a group of arguments, and what reads the others of the group.
  struct Keyword {
    std::string word;
    std::function<void()> read;
  };

  template <typename Value> using Choices = std::vector<std::pair<std::string, Value>>;

  /// `style` is as in an input script, for example "fix rbc/ib"; arguments before `first` are read
  /// already.
  Arguments(LAMMPS *lmp, std::string style, int narg, char **arg, int first = 0);

  /// Reads groups of keywords in any order to the end.
  void read(const std::vector<Keyword> &keywords);

  /// The same up to the first word that is none of them; the place of that.
  int read_known(const std::vector<Keyword> &keywords);

  bool at_end() const { return next_ >= narg_; }

  /// Whether the next argument is that word, which is taken then.
  bool take(const std::string &word);
  bool next_is_number() const;

  // Each takes the next argument. `name` says what it is, where the keyword alone does not.

  std::string text();
  double number();
  double positive(const std::string &name = "");
  double not_negative(const std::string &name = "");
  /// Between two values, which are not allowed themselves.
  double between(double low, double high, const std::string &name = "");
  int whole(int least, int most, const std::string &name = "");
  bool logical();
  NumberOrVariable number_or_variable();
  std::array<NumberOrVariable, 3> vector();

  template <typename Value>
  Value choice(const Choices<Value> &choices, const std::string &name = "")
  {
    const std::string word = text();
    for (const auto &[allowed, value] : choices)
      if (word == allowed) return value;
    std::vector<std::string> words;
    for (const auto &[allowed, value] : choices) words.push_back(allowed);
    unknown(named(name), word, words);
  }

  /// An error about the last argument taken.
  template <typename... Values>
  [[noreturn]] void fail(const std::string &format, Values &&...values)
  {
    stop(fmt::format(fmt::runtime(format), values...));
  }

  /// The arguments that follow belong to a word after the keyword, which messages name, too.
  void enter(const std::string &word) { keyword_ += (keyword_.empty() ? "" : " ") + word; }

  /// "Fix rbc/ib": the style at the start of a sentence.
  std::string style() const;
  const std::string &keyword() const { return keyword_; }

  /// Place of the last argument taken.
  int last() const { return next_ - 1; }

 private:
  std::string style_, keyword_;
  int narg_;
  char **arg_;
  int next_;

  std::string named(const std::string &name) const { return name.empty() ? keyword_ : name; }
  [[noreturn]] void stop(const std::string &message);
  [[noreturn]] void refuse(const std::string &name, const std::string &range);
  [[noreturn]] void unknown(const std::string &what, const std::string &word,
                            const std::vector<std::string> &allowed);
};

}    // namespace LAMMPS_NS

#endif
