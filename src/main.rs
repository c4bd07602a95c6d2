//! `frictionsim`: see [`frictionsim::app`].

fn main() -> std::process::ExitCode {
    frictionsim::app::main()
}
