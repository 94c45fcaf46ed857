// Answers of the native library, for comparison: the program tests/javascript/native_answers.cpp.
import { spawnSync } from "node:child_process";

export const program = process.env.CHASLES_NATIVE_ANSWERS;
export const skip = program ? false : "skipped: CHASLES_NATIVE_ANSWERS names no program of native answers";

/** The answers to lines of questions, without the lines of bodies. */
export function nativeAnswers(lines, rounds = 0) {
  const input = lines.map((line) => JSON.stringify(line)).join("\n") + "\n";
  const { stdout, status, stderr } = spawnSync(program, [String(rounds)], { input, maxBuffer: 2 ** 31 - 1 });
  if (status !== 0) throw new Error(`native answers: status ${status}: ${stderr}`);
  return stdout.toString().trimEnd().split("\n").map((line) => JSON.parse(line));
}

const renamed = { max_turn: "maxTurn", fixed_start: "fixedStart", fixed_goal: "fixedGoal", fixed_centre: "fixedCentre" };

/** The options of a question as the package names them. */
export function optionsOf(question) {
  const options = {};
  for (const key of ["margin", "hold", "find", "motion", "centre", "tolerance", "until", ...Object.keys(renamed)])
    if (question[key] !== undefined) options[renamed[key] ?? key] = question[key];
  return options;
}

/** An answer with the keys of the command line only. */
export function asCommandLine({ fixed_pose, ...answer }) {
  return answer;
}
