//! What the parser of the command line says, as one line.

/// An error of the parser of options, as one line.
pub fn line(error: &clap::Error) -> String {
    first_paragraphs(&error.render().to_string())
}

/// The parser's message and its tips on one line, without the usage that follows.
fn first_paragraphs(text: &str) -> String {
    let text = text.strip_prefix("error: ").unwrap_or(text);
    let lines = text.lines().map(str::trim).take_while(|line| {
        !line.starts_with("Usage:") && !line.starts_with("For more information")
    });
    // The tip on passing a value that looks like an option does not help a user who mistyped an option.
    let lines = lines.filter(|line| !line.starts_with("tip: to pass "));
    let mut sentence = String::new();
    for line in lines.filter(|line| !line.is_empty()) {
        if !sentence.is_empty() {
            sentence.push_str(if sentence.ends_with(':') { " " } else { "; " });
        }
        sentence.push_str(line);
    }
    if sentence.starts_with("unexpected argument") && !sentence.contains("tip:") {
        sentence.push_str("; --help lists what there is");
    }
    if let Some(word) =
        sentence.strip_prefix("the subcommand ").filter(|_| sentence.ends_with("'[SCENE]'"))
    {
        let word = word.split(' ').next().unwrap_or_default();
        return format!("{word} cannot follow a scene; a command stands first and takes --scene");
    }
    sentence
        .replace("tip: a similar argument exists:", "did you mean")
        .replace("tip: a similar value exists:", "did you mean")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_of_the_parser_become_one_line() {
        let text = "error: unexpected argument '--sett' found\n\n  tip: a similar argument exists: \
                    '--set'\n\nUsage: hopfscope\n\nFor more information, try '--help'.\n";
        let line = "unexpected argument '--sett' found; did you mean '--set'";
        assert_eq!(first_paragraphs(text), line);
        let text = "error: unexpected argument '--xyz' found\n\n  tip: to pass '--xyz' as a value, use \
                    '-- --xyz'\n\nUsage: hopfscope\n";
        let line = "unexpected argument '--xyz' found; --help lists what there is";
        assert_eq!(first_paragraphs(text), line);
        let text =
            "error: the subcommand 'extra' cannot be used with '[SCENE]'\n\nUsage: hopfscope\n";
        let line = "'extra' cannot follow a scene; a command stands first and takes --scene";
        assert_eq!(first_paragraphs(text), line);
        let text = "error: these were not provided:\n  --over <RANGE>\n\nUsage: hopfscope\n";
        assert_eq!(first_paragraphs(text), "these were not provided: --over <RANGE>");
    }
}
