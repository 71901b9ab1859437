//! The built-in machines.

use std::sync::LazyLock;

use super::Machine;
use super::file::parse;
use crate::scene::mistake::{built_in, texts};
use crate::words::one_of;

/// The machine that is used unless another is named.
pub const TEXTBOOK: &str = "textbook";

/// The files, in the order in which they are listed.
const FILES: [(&str, &str); 6] = texts! { "/assets/belts/":
    "textbook" "clutch" "slideway" "straight" "bstab" "groan"
};

/// The tables that these files refer to.
const TABLES: [(&str, &str); 1] =
    [("slideway.csv", include_str!("../../../assets/belts/slideway.csv"))];

/// The built-in machines, in the order in which they are listed.
pub fn machines() -> &'static [Machine] {
    static MACHINES: LazyLock<Vec<Machine>> = LazyLock::new(|| {
        let read = built_in(&FILES, |name, file, text| parse(name, file, text, table_named));
        read.into_iter().filter_map(|described| described.try_into().ok()).collect()
    });
    &MACHINES
}

/// A built-in table.
fn table_named(name: &str) -> Result<String, String> {
    let found = TABLES.iter().find(|(table, _)| *table == name);
    found.map(|(_, text)| (*text).to_owned()).ok_or_else(|| format!("there is no table {name:?}"))
}

/// The built-in machine with this name. Fails with one line that names all.
pub fn find(name: &str) -> Result<&'static Machine, String> {
    one_of("machine", name, machines().iter().map(|machine| (machine.name.as_str(), machine)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_library_lists_every_file_of_the_folder() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/belts");
        let entries = std::fs::read_dir(folder).unwrap();
        let mut on_disk: Vec<String> = entries
            .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
            .collect();
        let files = FILES.iter().map(|(name, _)| format!("{name}.toml"));
        let mut listed: Vec<String> =
            files.chain(TABLES.iter().map(|(name, _)| (*name).to_owned())).collect();
        on_disk.sort();
        listed.sort();
        assert_eq!(on_disk, listed);
    }

    #[test]
    fn every_machine_reads_explains_itself_and_has_a_dimensionless_form() {
        for machine in machines() {
            assert!(machine.title.chars().count() <= 52, "{}: a short title", machine.name);
            assert!(machine.watch.ends_with('.') && machine.watch.len() > 20, "{}", machine.name);
            let reduced = machine.belt.reduce().unwrap();
            assert!(reduced.parameters.d.abs() < 1.0, "{}", machine.name);
            assert!(reduced.sticking_velocity > 0.0);
        }
        assert_eq!(machines()[0].name, TEXTBOOK);
    }
}
