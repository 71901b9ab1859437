//! Reports: claims, trade, costs of scenes, provenance, certified bounds.

use super::*;

#[test]
fn the_paper_against_computation_is_a_document_a_table_and_rows() {
    let document = json("paper");
    let claims = document["claims"].as_array().unwrap();
    assert!(claims.len() > 90);
    for claim in claims {
        assert_eq!(
            keys(claim),
            "at basis bound cases claim computed corrected difference equation error held lower paper proof reason scene section sense upper verdict within"
        );
        let verdicts = ["agrees", "approximates", "corrected", "in-part", "false"];
        assert!(verdicts.contains(&claim["verdict"].as_str().unwrap()), "{claim}");
        assert!(number(&claim["bound"]) >= 0.0);
    }
    let of = |equation: &str| claims.iter().find(|claim| claim["equation"] == equation).unwrap();
    assert_eq!(of("(33)")["verdict"], "corrected");
    assert!(number(&of("(33)")["paper"]) < 0.0);
    assert_eq!(of("D_c")["paper"], Value::Null);
    assert!(close(&of("D_c")["computed"], -0.776_232, 1e-6));

    let table = run(&["paper"]).out;
    assert!(table.contains("corrected: holds") && table.contains("claims: "), "{table}");
    let rows = run(&["paper", "--format", "csv"]).out;
    assert!(rows.starts_with("equation,section,claim,at,"));
    // No statement or place contains a line break: one line each.
    assert_eq!(rows.lines().count(), claims.len() + 1);
}

#[test]
fn trade_shows_what_each_digit_costs_and_which_methods_never_rest() {
    let w1 = "trade --set D=-0.1 --set D3=0.05 --set r=0.1 --set q0=3 --until 200";
    let document = json(w1);
    let rows = document["rows"].as_array().unwrap();
    let errors = |method: &str| {
        let rows = rows.iter().filter(|row| row["method"] == method);
        rows.map(|row| row["error"].as_f64().unwrap()).collect::<Vec<_>>()
    };
    assert!(errors("taylor").iter().any(|error| *error < 1e-13));
    assert!(errors("dop853")[0] > 1e-3);
    assert!(rows.iter().all(|row| row["seconds"].as_f64().unwrap() > 0.0));
    assert!(document["reference"].as_str().unwrap().contains("twice the working precision"));
    assert!(document["reference_error"].as_f64().unwrap() < 1e-25);
    // From (2, 0) at r = 0.5 it comes to rest; without events it never does.
    let document = json("trade --set D=-0.1 --set r=0.5 --set q0=2 --until 50");
    for row in document["rows"].as_array().unwrap() {
        let never = row["method"] == "smoothed" || row["method"] == "sign-rk4";
        assert_eq!(row["outcome"]["kind"] == "moving", never, "{row}");
    }
    let table = run(&["trade", "linear"]);
    assert!(
        table.code == 0 && table.out.contains("the closed form in doubles by"),
        "{}",
        table.out
    );
}

#[test]
fn scenes_report_their_cost_and_what_a_step_recomputes() {
    let document: Value =
        serde_json::from_str(&run(&["scenes", "--cost", "--format", "json"]).out).unwrap();
    let scenes = document.as_array().unwrap();
    let of = |name: &str| scenes.iter().find(|scene| scene["scene"] == name).unwrap();
    let plain = of("plain");
    assert_eq!(keys(plain), "evaluations formulas questions scene seconds steps");
    let question = |scene: &Value, name: &str| {
        let questions = scene["questions"].as_array().unwrap();
        questions.iter().find(|question| question["question"] == name).cloned().unwrap()
    };
    // Closed form: one evaluation for each half swing, no integration.
    let motion = json("trajectory --scene plain");
    let swings = motion["events"].as_array().unwrap().len();
    let evaluations = question(plain, "motion")["evaluations"].as_u64().unwrap();
    assert!(evaluations <= swings as u64 + 1, "{evaluations}");
    assert!(number(&question(of("supercritical"), "motion")["evaluations"]) > 100.0);
    // A step of the start requires only the motion and keeps everything else.
    for scene in scenes {
        let steps = scene["steps"].as_array().unwrap();
        let start = steps.iter().find(|step| step["parameter"] == "q0").unwrap();
        for asked in start["recomputed"].as_array().unwrap() {
            assert!(asked == "motion" || asked == "motions", "{}: {asked}", scene["scene"]);
        }
        // Only variants with their own start keep their motion.
        let held = find(scene["scene"].as_str().unwrap()).unwrap();
        let variants = held.families.iter().flatten();
        let own = variants.filter(|variant| variant.held.contains_key(&Knob::Q0)).count();
        let reused = start["reused"].as_array().unwrap();
        let reused = reused.iter().filter(|name| *name == "motion").count();
        assert!(reused <= own, "{}: {reused} of {own}", held.name);
        assert_eq!(reused > 0, own > 0, "{}", held.name);
    }
}

#[test]
fn an_answer_in_a_file_says_where_it_comes_from_and_replaces_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("motion.csv").display().to_string();
    let line = ["trajectory", "--until", "9", "--format", "csv", "--write", &path];
    assert_eq!((run(&line).code, run(&line).out.as_str()), (0, ""));
    let plain = run(&line[..5]).out;
    assert_eq!(std::fs::read_to_string(&path).unwrap(), plain);
    let beside = std::fs::read_to_string(path.clone() + ".provenance").unwrap();
    let origin: Value = serde_json::from_str(&beside).unwrap();
    assert_eq!(origin["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(origin["command"], format!("hopfscope {}", line.join(" ")));
    let other = run(&["trajectory", "--until", "8", "--format", "csv", "--write", &path]);
    other.is_refused(&[&path]);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), plain);
}

/// In a clone: a commit of the repository, perhaps with changes. In an unpacked package there is none.
#[test]
fn a_build_knows_the_revision_that_git_knows() {
    let git = |words: &[&str]| {
        let folder = env!("CARGO_MANIFEST_DIR");
        std::process::Command::new("git").args(["-C", folder]).args(words).output().ok()
    };
    let top = git(&["rev-parse", "--show-prefix"]).filter(|it| it.status.success());
    let is_clone = top.is_some_and(|it| it.stdout.trim_ascii().is_empty());
    let revision = &json("cycles")["provenance"]["revision"];
    assert_eq!(revision.is_string(), is_clone, "{revision}");
    if let Some(revision) = revision.as_str() {
        let commit = revision.strip_suffix("-dirty").unwrap_or(revision);
        assert!(git(&["cat-file", "-e", commit]).unwrap().status.success(), "{revision}");
    }
}

#[test]
fn a_stiffness_without_the_unit_that_was_meant_brings_a_warning() {
    let warned = run(&["belt", "textbook", "--set", "c=5"]);
    assert_eq!(warned.code, 0);
    assert_eq!(warned.err.lines().count(), 1, "{}", warned.err);
    assert!(warned.err.contains("x0 = 5.5 m, the spring's deflection"), "{}", warned.err);
    assert_eq!(run(&["belt", "textbook"]).err, "");
}

/// In every row, each column with bounds: the number lies between them, up to the error of the search.
#[test]
fn rows_have_the_bounds_of_their_numbers() {
    for (line, bounded) in [
        ("cycles --set D=-0.2 --set D2=0.2 --set D3=0.5 --set r=0.1", 14),
        ("cycles --set D=-0.2 --set D2=0.2 --set D3=0.5 --set r=0.1+-0.0001", 0),
        ("trajectory --set D=-0.1 --set r=0.5 --set q0=2 --until 50 --certify", 14),
        ("basin --set D=-0.2 --set D2=0.2 --set D3=0.5 --set r=0.1 --grid 3x3 --certify", 4),
        ("branch --set D3=0.5 --set r=0.1 --over D=-0.5:-0.4:5 --certify", 0),
        ("border --over D3=0.5:1:2 --set D2=0.2 --certify", 2),
    ] {
        let words: Vec<&str> = line.split(' ').chain(["--format", "csv"]).collect();
        let text = run(&words).out;
        let mut rows = text.lines().map(|row| row.split(',').collect::<Vec<_>>());
        let names = rows.next().unwrap();
        assert!(names.contains(&"proved"), "{line}: {names:?}");
        let (mut count, mut proved) = (0, 0);
        for row in rows {
            let cell = |name: &str| {
                names.iter().position(|it| *it == name).and_then(|at| row[at].parse::<f64>().ok())
            };
            proved +=
                usize::from(row[names.iter().position(|it| *it == "proved").unwrap()] == "true");
            for name in &names {
                let ends = ["lower", "upper"].map(|end| cell(&format!("{name}_{end}")));
                let (Some(value), [Some(lower), Some(upper)]) = (cell(name), ends) else {
                    continue;
                };
                let slack = 1e-9 * value.abs();
                assert!(lower - slack <= value && value <= upper + slack, "{line}: {name} {row:?}");
                assert!(upper - lower <= 1e-9 * value.abs(), "{line}: {name} {row:?}");
                count += 1;
            }
        }
        assert!(count == bounded && proved > 0, "{line}: {count} {proved}\n{text}");
    }
}

#[test]
fn a_certified_border_encloses_its_folds_and_escape_points() {
    let folds = json("border --over D3=0.5:1:2 --set D2=0.2 --certify");
    let fold = &folds["certified"][0]["fold"];
    // The fold of `the_fold_is_where_it_was_computed_elsewhere`.
    let known = -0.172_784_103_071_94;
    let [lower, upper] = ["lower", "upper"].map(|end| number(&fold[end]));
    assert!(lower - 1e-14 <= known && known <= upper + 1e-14 && upper - lower < 1e-13, "{fold}");
    let escapes = json("border --over r=0.2:1:2 --set D2=0.5 --certify");
    for (point, known) in
        escapes["certified"].as_array().unwrap().iter().zip([-0.079_769, -0.396_442])
    {
        let [lower, upper] = ["lower", "upper"].map(|end| number(&point["escape"][end]));
        assert!((lower - known).abs() < 1e-6 && (0.0..1e-10).contains(&(upper - lower)), "{point}");
    }
    for document in [folds, escapes] {
        for (point, plain) in document["certified"]
            .as_array()
            .unwrap()
            .iter()
            .zip(document["points"].as_array().unwrap())
        {
            assert!(
                point["proved"] == true && point["open"].as_array().unwrap().is_empty(),
                "{point}"
            );
            for (bounds, found) in
                [(&point["escape"], &plain["escape"]), (&point["fold"], &plain["fold"])]
            {
                assert_eq!(bounds.is_null(), found.is_null(), "{point} {plain}");
            }
        }
    }
}
