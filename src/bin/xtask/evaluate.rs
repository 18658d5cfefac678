//! `cargo xtask evaluate`: the dissertation's chapters 6 and 8 with ground truth, as a page of tables and plots.

use crate::run::{Outcome, report, root, run};
use crate::setup;
use crate::test::tests;

/// Writes target/evaluation/index.html. In the test profile, on the adapter that the tests take: seconds are not what
/// it is about, ratios are.
pub(crate) fn evaluate() -> Outcome {
    setup::for_tests()?;
    let mut command = tests(&["--test", "evaluate", "--", "--ignored", "--nocapture"]);
    run("evaluate", &mut command)?;
    let page = root().join("target/evaluation/index.html");
    report(&format!("look at {}", page.display()));
    Ok(())
}
