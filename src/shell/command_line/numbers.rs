//! Lines of numbers with commas between them, as `fabrica probe` reads them.

use std::io::{self, BufRead, Read as _};
use std::path::Path;

use super::error::CliError;
use super::output::shortened;

/// Longest line, bytes.
const MAX_LINE: u64 = 4096;
/// Numbers of a line that are looked at: more than any command takes.
const MAX_NUMBERS: usize = 16;

/// The numbers of each line of a file, or of standard input without one. Empty lines and those that begin with `#` are
/// left out. `expected` says in words what each line holds.
///
/// # Errors
/// [`CliError::Read`]; [`CliError::Numbers`] with the line that does not hold `N` finite numbers.
pub(super) fn read_numbers<const N: usize>(
    path: Option<&Path>,
    expected: &'static str,
) -> Result<Vec<[f64; N]>, CliError> {
    read_lines(path, expected, |numbers| numbers.try_into().ok())
}

/// As [`read_numbers`], of points in a plane: the third number of a line may be there and is left aside.
///
/// # Errors
/// As [`read_numbers`].
pub(super) fn read_flat_points(
    path: Option<&Path>,
    expected: &'static str,
) -> Result<Vec<[f64; 2]>, CliError> {
    read_lines(path, expected, |numbers| match numbers[..] {
        [x, y] | [x, y, _] => Some([x, y]),
        _ => None,
    })
}

fn read_lines<T>(
    path: Option<&Path>,
    expected: &'static str,
    of: impl Fn(Vec<f64>) -> Option<T>,
) -> Result<Vec<T>, CliError> {
    let Some(path) = path else {
        return lines_of(io::stdin().lock(), "standard input", expected, of);
    };
    let shown = path.display().to_string();
    let file = std::fs::File::open(path).map_err(|source| CliError::Read {
        path: shown.clone(),
        source,
    })?;
    lines_of(io::BufReader::new(file), &shown, expected, of)
}

fn lines_of<T>(
    mut from: impl BufRead,
    path: &str,
    expected: &'static str,
    of: impl Fn(Vec<f64>) -> Option<T>,
) -> Result<Vec<T>, CliError> {
    let mut all = Vec::new();
    let mut bytes = Vec::new();
    for line in 1.. {
        bytes.clear();
        let n = (&mut from)
            .take(MAX_LINE)
            .read_until(b'\n', &mut bytes)
            .map_err(|source| CliError::Read {
                path: path.to_owned(),
                source,
            })?;
        if n == 0 {
            break;
        }
        let text = String::from_utf8_lossy(&bytes);
        let text = text.trim().trim_start_matches('\u{feff}');
        if text.is_empty() || text.starts_with('#') {
            continue;
        }
        all.push(parse(text).and_then(&of).ok_or_else(|| CliError::Numbers {
            path: path.to_owned(),
            line,
            expected,
            found: shortened(text),
        })?);
    }
    Ok(all)
}

fn parse(text: &str) -> Option<Vec<f64>> {
    let numbers = text.split(',').map(|number| {
        let number = number.trim().parse::<f64>().ok()?;
        // The map is evaluated in 32 bits, which must hold it too.
        (number.is_finite() && (number as f32).is_finite()).then_some(number)
    });
    numbers.take(MAX_NUMBERS).collect()
}
