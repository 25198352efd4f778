//! The command `rotordyn`.

mod cli;

fn main() -> std::process::ExitCode {
    cli::run()
}
