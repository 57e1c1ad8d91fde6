// The small language of angles in lobe tables, read by recursive descent:
//   sum = product { (+|-) product },  product = factor { (*|/) factor },
//   factor = - factor | ( sum ) | sqrt ( sum ) | acos ( sum ) | pi | number.

#include "exact/angles.hpp"

#include <boost/math/constants/constants.hpp>
#include <stdexcept>
#include <string>

namespace zonal::exact {
namespace {

class Reader {
  public:
    explicit Reader(std::string_view text) : text_(text) {}

    Real whole() {
        const Real value = sum();
        skip_blanks();
        if (place_ != text_.size()) fail();
        return value;
    }

  private:
    Real sum() {
        Real value = product();
        while (true) {
            if (take("+")) {
                value += product();
            } else if (take("-")) {
                value -= product();
            } else {
                return value;
            }
        }
    }

    Real product() {
        Real value = factor();
        while (true) {
            if (take("*")) {
                value *= factor();
            } else if (take("/")) {
                const Real divisor = factor();
                if (divisor == 0) fail();
                value /= divisor;
            } else {
                return value;
            }
        }
    }

    Real factor() {
        if (take("-")) return -factor();
        if (take("sqrt")) {
            const Real radicand = parenthesised();
            if (radicand < 0) fail();
            return sqrt(radicand);
        }
        if (take("acos")) {
            const Real cosine = parenthesised();
            if (abs(cosine) > 1) fail();
            return acos(cosine);
        }
        if (take("pi")) return boost::math::constants::pi<Real>();
        return next() == '(' ? parenthesised() : number();
    }

    Real parenthesised() {
        if (!take("(")) fail();
        const Real value = sum();
        if (!take(")")) fail();
        return value;
    }

    Real number() {
        skip_blanks();
        const std::size_t length =
            std::min(text_.find_first_not_of("0123456789.", place_), text_.size()) - place_;
        const std::string_view digits = text_.substr(place_, length);
        const bool has_digit = digits.find_first_not_of('.') != std::string_view::npos;
        if (!has_digit || digits.find('.') != digits.rfind('.')) fail();
        place_ += length;
        return Real{std::string(digits)};
    }

    bool take(std::string_view word) {
        skip_blanks();
        if (text_.substr(place_, word.size()) != word) return false;
        place_ += word.size();
        return true;
    }

    char next() {
        skip_blanks();
        return place_ < text_.size() ? text_[place_] : '\0';
    }

    void skip_blanks() {
        while (place_ < text_.size() && text_[place_] == ' ') ++place_;
    }

    [[noreturn]] void fail() const {
        throw std::invalid_argument("cannot read \"" + std::string(text_) + "\" from character " +
                                    std::to_string(place_ + 1));
    }

    std::string_view text_;
    std::size_t place_ = 0;
};

}  // namespace

Real evaluate_closed_form(std::string_view text) { return Reader(text).whole(); }

std::string decimal_text(const Real& value) { return value.str(50, std::ios_base::fmtflags{}); }

Direction<Real> direction_of(const Real& theta, const Real& phi) {
    const Real radius = sin(theta);
    Direction<Real> direction{radius * cos(phi), radius * sin(phi), cos(theta)};
    for (Real& component : direction) {
        if (abs(component) < Real{"1e-45"}) component = 0;
    }
    return direction;
}

}  // namespace zonal::exact
