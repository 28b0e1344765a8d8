/** The files of evaluations: `evaluations/<name>.yaml`. */
export const EVALUATION_FILE = /^evaluations\/([^/]+)\.yaml$/;
const NAME = /^[A-Za-z0-9][A-Za-z0-9_-]{0,59}$/;

export const evaluationPath = (name: string): string => `evaluations/${name}.yaml`;

/** Returns the names of a project's evaluations, in order. */
export const evaluationNames = (paths: readonly string[]): string[] =>
  paths.flatMap((path) => EVALUATION_FILE.exec(path)?.[1] ?? []).sort();

/** Returns whether a text can be the name of a new evaluation. */
export const isEvaluationName = (name: string): boolean => NAME.test(name);

/** Returns the text of a new evaluation, with the comments that its writer needs. */
export const firstEvaluation = (universe: string): string => `format: bt-studio/evaluation
version: 1
universe: ${universe}
duration_s: 20
runs: 20
# What differs from run to run; each seed draws its own values.
vary:
  ground.friction: [0.6, 1.0]
judge:
  success:
    - never: collision
  measure: [path_length_m, smallest_clearance_m]
`;
