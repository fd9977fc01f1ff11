#ifndef LMP_RBC_ARGUMENTS_H
#define LMP_RBC_ARGUMENTS_H

#include "pointers.h"
#include "support/rbc_number_or_variable.h"

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

/// Reads the arguments of a style one after the other.
///
/// All ranks read the same arguments. Wrong input is an error of LAMMPS on all of them: it names
/// the style, the keyword, the value and what is allowed, and it marks the argument in the line of
/// the input script. The numbers are those of LAMMPS's utils::numeric() and utils::inumeric().
class Arguments : protected Pointers {
 public:
  /// A word that begins a group of arguments, and the function that reads the rest of the group.
  struct Keyword {
    std::string word;
    std::function<void()> read;
  };

  /// The words that an argument may be, each with its meaning.
  template <typename Value> using Choices = std::vector<std::pair<std::string, Value>>;

  /// `style` is written as in an input script, for example "fix rbc/ib". The arguments before
  /// `first` are not read. An error if there are fewer of them than that.
  Arguments(LAMMPS *lmp, std::string style, int narg, char **arg, int first = 0);

  /// Reads groups of keywords, in any order, up to the end. An error at a word that is no keyword:
  /// its message lists the keywords in the order of the table.
  void read(const std::vector<Keyword> &keywords);

  /// Reads groups of keywords up to the first word that is no keyword; returns its index in `arg`.
  int read_known(const std::vector<Keyword> &keywords);

  bool at_end() const { return next_ >= narg_; }

  /// The next argument, which stays the next one; empty at the end.
  std::string peek() const { return at_end() ? "" : arg_[next_]; }

  /// Takes the next argument if it is that word.
  bool take(const std::string &word);
  bool next_is_number() const;

  // Each of the following takes the next argument. An error if there is none. `name` stands for
  // the argument in messages where the keyword alone would be ambiguous, as "adapt error".

  std::string text();
  double number(const std::string &name = "");
  double positive(const std::string &name = "");
  double not_negative(const std::string &name = "");

  /// A number above `low` and below `high`.
  double between(double low, double high, const std::string &name = "");

  /// An integer from `least` to `most`.
  int whole(int least, int most, const std::string &name = "");
  bool logical();

  /// A number of an atom type or its type label.
  int atom_type(const std::string &name = "");

  /// A number or v_name. Whether the variable exists is checked later, by NumberOrVariable.
  NumberOrVariable number_or_variable();
  std::array<NumberOrVariable, 3> vector();

  /// The meaning of a word. The error about an unknown word lists those allowed.
  template <typename Value>
  Value choice(const Choices<Value> &choices, const std::string &name = "")
  {
    const std::string word = text();
    std::vector<std::string> words;
    for (const auto &[allowed, value] : choices) {
      if (word == allowed) return value;
      words.push_back(allowed);
    }
    unknown(named(name), word, words);
  }

  /// Stops with an error that marks the argument taken last.
  template <typename... Values>
  [[noreturn]] void fail(const std::string &format, Values &&...values)
  {
    stop(fmt::format(fmt::runtime(format), values...));
  }

  /// The argument taken last, as it was typed.
  std::string word() const { return arg_[next_ - 1]; }

  /// The arguments that follow belong to a word after the keyword, and messages name that, too.
  void enter(const std::string &word) { keyword_ += (keyword_.empty() ? "" : " ") + word; }

 private:
  std::string style_, keyword_;
  int narg_;
  char **arg_;
  int next_;

  std::string named(const std::string &name) const { return name.empty() ? keyword_ : name; }
  std::string sentence_start() const;
  int place_in_line() const;
  [[noreturn]] void stop(const std::string &message);
  [[noreturn]] void refuse(const std::string &name, const std::string &value,
                           const std::string &range);
  [[noreturn]] void unknown(const std::string &what, const std::string &word,
                            const std::vector<std::string> &allowed);
};

}    // namespace LAMMPS_NS

#endif
