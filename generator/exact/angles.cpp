// The small language of angles in lobe tables, as a Boost.Spirit grammar.
#include "exact/angles.hpp"

#include <boost/spirit/home/x3.hpp>
#include <stdexcept>
#include <string>

namespace zonal::exact {
namespace {

namespace x3 = boost::spirit::x3;

namespace grammar {

const x3::rule<struct SumRule, Real> sum = "sum";
const x3::rule<struct ProductRule, Real> product = "product";
const x3::rule<struct FactorRule, Real> factor = "factor";

const auto assign = [](auto& c) { x3::_val(c) = x3::_attr(c); };
const auto add = [](auto& c) { x3::_val(c) += x3::_attr(c); };
const auto subtract = [](auto& c) { x3::_val(c) -= x3::_attr(c); };
const auto multiply = [](auto& c) { x3::_val(c) *= x3::_attr(c); };
const auto negate = [](auto& c) { x3::_val(c) = -x3::_attr(c); };
// What has no value does not match.
const auto divide = [](auto& c) {
    x3::_pass(c) = x3::_attr(c) != 0;
    if (x3::_pass(c)) x3::_val(c) /= x3::_attr(c);
};
const auto square_root = [](auto& c) {
    x3::_pass(c) = x3::_attr(c) >= 0;
    if (x3::_pass(c)) x3::_val(c) = sqrt(x3::_attr(c));
};
const auto arc_cosine = [](auto& c) {
    x3::_pass(c) = abs(x3::_attr(c)) <= 1;
    if (x3::_pass(c)) x3::_val(c) = acos(x3::_attr(c));
};
const auto pi = [](auto& c) { x3::_val(c) = exact::pi(); };
const auto decimal = [](auto& c) {
    try {
        x3::_val(c) = Real{std::string(x3::_attr(c).begin(), x3::_attr(c).end())};
    } catch (const std::runtime_error&) {
        x3::_pass(c) = false;
    }
};

const auto parenthesised = '(' >> sum >> ')';
const auto exponent = x3::lit('e') >> -x3::char_("+-") >> +x3::digit;
const auto sum_def = product[assign] >> *('+' >> product[add] | '-' >> product[subtract]);
const auto product_def = factor[assign] >> *('*' >> factor[multiply] | '/' >> factor[divide]);
const auto factor_def = '-' >> factor[negate] | "sqrt" >> parenthesised[square_root] |
                        "acos" >> parenthesised[arc_cosine] | x3::lit("pi")[pi] | parenthesised[assign] |
                        x3::raw[x3::lexeme[+x3::digit >> -('.' >> *x3::digit) >> -exponent]][decimal];

BOOST_SPIRIT_DEFINE(sum, product, factor)

}  // namespace grammar
}  // namespace

Real evaluate_closed_form(std::string_view text) {
    constexpr std::size_t kMostCharacters = 500;  // the grammar calls itself for every bracket
    if (text.size() > kMostCharacters)
        throw std::invalid_argument("cannot read \"" + std::string(text.substr(0, 20)) + "…\": it has " +
                                    std::to_string(text.size()) + " characters, more than " +
                                    std::to_string(kMostCharacters));
    Real value;
    auto place = text.begin();
    if (!x3::phrase_parse(place, text.end(), grammar::sum, x3::blank, value) || place != text.end())
        throw std::invalid_argument("cannot read \"" + std::string(text) + "\" from character " +
                                    std::to_string(place - text.begin() + 1));
    return value;
}

std::string decimal_text(const Real& value) { return value.str(50); }

Direction<Real> direction_of(const Real& theta, const Real& phi) {
    const Real radius = sin(theta);
    Direction<Real> direction{radius * cos(phi), radius * sin(phi), cos(theta)};
    for (Real& component : direction) {
        if (abs(component) < Real{"1e-45"}) component = 0;
    }
    return direction;
}

}  // namespace zonal::exact
