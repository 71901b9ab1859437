//! The search in lists: synonyms, and the order of the rows found.

/// Synonyms for names of commands, lines, scenes, views and layers.
pub(in crate::session) const ALIASES: &[(&str, &[&str])] = &[
    ("walk-to-next", &["fold", "special point", "limit point", "jump"]),
    ("walk", &["continuation", "follow"]),
    ("save-figure", &["export", "picture", "svg", "png", "pdf", "print"]),
    ("figure", &["export", "picture", "svg", "png", "pdf", "print", "data"]),
    ("save-scan", &["export", "data", "csv"]),
    ("scan-form", &["scan", "sweep", "grid", "batch"]),
    ("scan", &["sweep", "grid", "batch"]),
    ("play-motion", &["play", "animate", "animation", "movie", "pause", "time"]),
    ("motion-pace", &["speed of playing", "faster", "slower"]),
    ("start-inside", &["kick", "capture"]),
    ("start-outside", &["kick", "escape"]),
    ("start-here", &["initial condition", "simulate"]),
    ("drop-motion", &["delete", "remove"]),
    ("drop-other-motions", &["clear", "delete", "remove"]),
    ("edit", &["change", "value", "number"]),
    ("undo", &["back", "revert", "history"]),
    ("reset-scene", &["restart", "restore"]),
    ("tol", &["tolerance", "accuracy", "precision"]),
    ("coarser", &["accuracy", "fast", "draft"]),
    ("finer", &["accuracy", "precise", "exact"]),
    ("next-method", &["method", "integrator", "solver"]),
    ("method", &["integrator", "solver"]),
    ("costs", &["performance", "time", "evaluations", "telemetry"]),
    ("views", &["plot type", "kind"]),
    ("add-plot", &["new plot", "split"]),
    ("remove-plot", &["close plot"]),
    ("enlarge", &["maximize", "full screen"]),
    ("equal", &["aspect", "circle", "square", "isometric"]),
    ("axes", &["axis", "period", "property"]),
    ("copy-number", &["copy", "yank", "clipboard", "value"]),
    ("copy-row", &["yank", "clipboard", "values"]),
    ("copy-screen", &["screenshot"]),
    ("theme", &["colour", "dark", "light", "contrast"]),
    ("color", &["colour", "depth"]),
    ("glyphs", &["braille", "ascii", "characters"]),
    ("write", &["save", "session"]),
    ("open", &["load", "session", "restore"]),
    ("restore", &["resume", "recover"]),
    ("quit", &["exit", "leave", "close"]),
    ("set-mark", &["mark", "bookmark", "compare"]),
    ("ghost", &["compare"]),
    ("fit", &["import", "data", "csv", "measurement"]),
    ("kicks", &["noise", "random"]),
    ("wider", &["uncertainty", "half width", "interval"]),
    ("safe", &["robust", "guaranteed"]),
    ("lyapunov", &["proof", "energy"]),
    ("explain", &["what is this", "about"]),
    ("help", &["keys", "shortcuts", "bindings", "manual"]),
    ("palette", &["search", "find"]),
    ("paper", &["equations", "theorems", "claims"]),
    ("tour", &["tutorial", "introduction", "demo"]),
    ("drop-cursor", &["cancel", "abort"]),
    ("diagram", &["branch", "continuation", "amplitude"]),
    ("regimes", &["stability chart", "two parameters"]),
    ("boundaries", &["border", "borders"]),
    ("harmonic-fold", &["harmonic-border"]),
    ("return-map", &["poincare", "cobweb"]),
    ("cycles", &["stable", "unstable", "orbit"]),
    ("groan", &["brake", "squeal", "chatter"]),
];

/// The synonyms for this name.
pub(in crate::session) fn aliases(name: &str) -> &'static [&'static str] {
    ALIASES.iter().find(|(known, _)| *known == name).map_or(&[], |(_, words)| words)
}

/// The rank of a row in a search, by its names and its meaning; 0 is best. Rows whose name is the searched text
/// come first, then those with words that begin with it, names before meanings. Without a search, all rows have
/// the same rank.
pub(in crate::session) fn rank(search: &str, names: &[&str], meaning: &str) -> usize {
    let search = Plain::new(search);
    let names: Vec<Plain> = names.iter().map(|name| Plain::new(name)).collect();
    let meaning = Plain::new(meaning);
    let any = |test: &dyn Fn(&Plain) -> bool| names.iter().any(test);
    let ranks = [
        any(&|name| name.joined() == search.joined()),
        any(&|name| name.joined().starts_with(&search.joined())),
        any(&|name| name.has_at_a_word(&search)),
        meaning.has_at_a_word(&search),
        any(&|name| name.0.contains(search.0.trim())),
        meaning.0.contains(search.0.trim()),
    ];
    ranks.iter().position(|holds| *holds).unwrap_or(ranks.len())
}

/// A text in lower case, with a blank before each word of letters and digits.
struct Plain(String);

impl Plain {
    fn new(text: &str) -> Self {
        let words = text.split(|char: char| !char.is_alphanumeric());
        let words = words.filter(|word| !word.is_empty());
        Plain(words.flat_map(|word| [" ".to_owned(), word.to_lowercase()]).collect())
    }

    /// The text without blanks: `fig 16` becomes `fig16`.
    fn joined(&self) -> String {
        self.0.replace(' ', "")
    }

    fn has_at_a_word(&self, search: &Plain) -> bool {
        self.0.contains(&search.0)
    }
}
