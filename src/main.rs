//! The program: a window and a command line natively, a page on the web. It only picks a shell.

fn main() {}
