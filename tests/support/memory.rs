//! How much memory something takes, measured from outside: the highest resident size of a process of its own.

use std::ffi::OsStr;
use std::process::Command;

/// A number out of the process's own status, in bytes.
fn status(key: &str) -> u64 {
    let text = std::fs::read_to_string("/proc/self/status").expect("Linux has it");
    let line = text
        .lines()
        .find(|line| line.starts_with(key))
        .expect("the key");
    let kilobytes: u64 = line
        .split_whitespace()
        .nth(1)
        .and_then(|number| number.parse().ok())
        .expect("a number");
    kilobytes * 1024
}

/// What a process of its own told of its work.
#[derive(Debug)]
pub(crate) struct Measured {
    /// Bytes that it held at most beyond those before the work.
    pub(crate) peak: u64,
    /// Wall clock of the work.
    pub(crate) seconds: f64,
    /// What came of it: a number that the work gives.
    pub(crate) result: u64,
}

impl Measured {
    /// Peak in MiB.
    pub(crate) fn mebibytes(&self) -> f64 {
        self.peak as f64 / (1 << 20) as f64
    }
}

/// In the measured process: does the work and prints what [`measure`] reads.
pub(crate) fn report(work: impl FnOnce() -> u64) {
    let before = status("VmRSS:");
    let start = std::time::Instant::now();
    let result = work();
    let seconds = start.elapsed().as_secs_f64();
    let peak = status("VmHWM:").saturating_sub(before);
    println!("peak {peak} seconds {seconds} result {result}");
}

/// Runs one test of this binary in a process of its own, which calls [`report`] where `variable` is set.
pub(crate) fn measure(test: &str, variable: &str, value: &OsStr) -> Measured {
    let output = Command::new(std::env::current_exe().expect("this test"))
        .args([test, "--exact", "--nocapture"])
        .env(variable, value)
        .output()
        .expect("it starts");
    let text = String::from_utf8_lossy(&output.stdout);
    let errors = String::from_utf8_lossy(&output.stderr);
    let line = text
        .lines()
        .find(|line| line.contains("peak "))
        .unwrap_or_else(|| panic!("no figures in {text} {errors}"));
    let words: Vec<&str> = line.split_whitespace().collect();
    let after = |key: &str| {
        let at = words.iter().position(|word| *word == key).expect(key);
        words[at + 1]
    };
    Measured {
        peak: after("peak").parse().expect("bytes"),
        seconds: after("seconds").parse().expect("seconds"),
        result: after("result").parse().expect("a number"),
    }
}
