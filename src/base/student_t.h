// Student's distribution: how far a mean is off when its standard error is estimated, too.
#pragma once

namespace tyndall {

// The probability that |t| is at least this for so many degrees of freedom (> 0; may be infinite, which is
// the normal distribution): the two-sided significance.
double student_t_two_sided(double t, double degrees_of_freedom);

// The significance of each of `count` independent tests that together have this one (Šidák).
double sidak_each(double together, double count);
// The significance of all together when the least of each is this.
double sidak_together(double least, double count);
// The same from the sum of the logarithms of each significance (Fisher 1932): many that are a little unlikely
// are very unlikely together.
double fisher_together(double sum_of_logarithms, int count);

}  // namespace tyndall
