/** What a workflow checks of a project. */
interface Checked {
  /** Whether the project has behaviour tests. */
  readonly hasTests: boolean;
  /** The names of its evaluations (`isEvaluationName`). */
  readonly evaluations: readonly string[];
}

const WORKFLOW_PATH = '.github/workflows/trees.yml';
const STUDIO = 'bt-studio/.venv/bin/bt-studio';

/**
 * Returns a workflow of GitHub that checks, tests and evaluates a project in a repository of its own. The page
 * `docs/how-to/test-in-ci.md` explains it; the repository that BT Studio comes from is left to the user.
 */
export function workflowOf({ hasTests, evaluations }: Checked): string {
  const results = [
    ...(hasTests ? ['tests.xml', 'coverage.json'] : []),
    ...evaluations.flatMap((name) => [`${name}.xml`, `results/${name}`]),
  ];
  const steps = [
    ...(hasTests ? [`${STUDIO} test project --junit tests.xml --coverage coverage.json`] : []),
    ...evaluations.map(
      (name) =>
        `${STUDIO} evaluate project ${name} --runs 60 --gate 'success>=0.95' --junit ${name}.xml --report results/${name}`,
    ),
  ];
  return `# Save this as ${WORKFLOW_PATH} in the repository of the project.
name: Trees
on: [push, pull_request]
permissions:
  contents: read
jobs:
  trees:
    runs-on: ubuntu-24.04
    timeout-minutes: 60
    steps:
      - uses: actions/checkout@v4
        with: {path: project}
      - uses: actions/checkout@v4
        with: {repository: your-organisation/bt-studio, path: bt-studio} # write where BT Studio comes from
      - uses: actions/setup-python@v5
        with: {python-version: "3.11"}
      - uses: actions/setup-node@v4
        with: {node-version: "20"}
      - run: make -C bt-studio setup
      - run: ${STUDIO} check project
${steps.map((step) => `      - run: ${step}\n`).join('')}${uploadOf(results)}`;
}

const uploadOf = (results: readonly string[]): string =>
  results.length === 0
    ? ''
    : `      - uses: actions/upload-artifact@v4
        if: always()
        with:
          name: results
          path: |
${results.map((path) => `            ${path}\n`).join('')}`;
