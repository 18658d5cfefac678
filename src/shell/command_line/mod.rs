//! The command line of the native program (spec/contract.md, "The command line").
//!
//! Results go to standard output, notices and errors to standard error, one line each; 0 is success, 1 an error, 2 bad
//! usage. A file that is written is whole or not there.

mod about;
mod args;
mod bench;
mod clay;
mod describe;
mod device;
mod error;
mod export;
mod fields;
mod figures;
mod info;
mod link;
mod numbers;
mod objects;
mod opening;
mod output;
mod probe;
mod progress;
mod rays;
mod reading;
mod render;
mod run;
mod stop;
mod subject;
mod svg;
mod templates;

pub use reading::ReadingFlags;
pub use run::run;
