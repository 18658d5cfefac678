//! What benchmarks share.

use std::fmt;

use serde_json::{Value, json};

/// A number that was measured, and the most that the specification lets it be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limited {
    /// What was measured, in words.
    pub name: &'static str,
    /// A ratio or a count.
    pub value: f64,
    /// The most that it may be.
    pub limit: f64,
}

impl Limited {
    /// True if the number is at most the limit.
    pub fn holds(&self) -> bool {
        self.value <= self.limit
    }

    /// All of it, and whether the limit holds.
    pub fn to_json(&self) -> Value {
        json!({ "name": self.name, "value": self.value, "limit": self.limit, "holds": self.holds() })
    }
}

impl fmt::Display for Limited {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let said = if self.holds() { "holds" } else { "is exceeded" };
        let Self { name, value, limit } = self;
        write!(f, "{name:<52} {value:>8.2}  (limit {limit}: {said})")
    }
}

/// The number in the middle, the upper one of two; 0 of none. Sorts them.
pub fn median(numbers: &mut [f64]) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_holds_up_to_itself_and_no_number_is_under_it() {
        let of = |value| Limited {
            name: "steps",
            value,
            limit: 1.2,
        };
        assert!(of(1.2).holds() && !of(1.21).holds() && !of(f64::NAN).holds());
        assert!(of(1.0).to_string().ends_with("(limit 1.2: holds)"));
        assert!(of(2.0).to_string().ends_with("(limit 1.2: is exceeded)"));
        assert_eq!(of(2.0).to_json()["holds"], false);
    }

    #[test]
    fn the_median_is_in_the_middle() {
        assert_eq!(median(&mut [3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(&mut []), 0.0);
    }
}
