//! Computes assets/ehl_similarity.csv again: solved EHL films of similar contacts, on standard output.
//!
//! `cargo run --release --example ehl_similarity > assets/ehl_similarity.csv` (about 16 min of CPU time). Then
//! `ROTORDYN_FILM_CONTACTS=64 cargo test -p rotordyn-bearing --test ehl` compares it with direct solutions.

fn main() -> Result<(), rotordyn::contact::ehl::EhlError> {
    let progress = |done: usize, total: usize| eprint!("\r{done} of {total} contacts");
    let text = rotordyn::contact::ehl::similarity::compute(progress)?;
    eprintln!();
    print!("{text}");
    Ok(())
}
