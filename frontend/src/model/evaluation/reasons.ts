/** A sentence of the executor or the server about a run or an evaluation, by its key and the values in it. */
export interface Reason {
  readonly key: ReasonKey;
  readonly values: Readonly<Record<string, string>>;
}

/**
 * The sentences that are known, each with its pattern; `tests/shared/test_reasons.py` holds the executor to them.
 * Outcomes are stored and exported with these sentences, so they are one language there, and translated here.
 */
const PATTERNS = {
  allHold: /^all items hold$/,
  late: /^(?<item>.+): the time is over$/,
  collision: /^never collision$/,
  closer: /^never closer than (?<distance>\S+) m to (?<to>.+)$/,
  reach: /^reach (?<area>\S+)$/,
  visitInOrder: /^visit (?<areas>.+) in order$/,
  visit: /^visit (?<areas>.+)$/,
  tree: /^tree (?<status>[A-Z]+)$/,
  judged: /^python (?<judge>\S+)$/,
  cpuLimitIn: /^the run took more than its limit of processor time in (?<file>.+)$/,
  cpuLimit: /^the run took more than its limit of processor time$/,
  realLimit: /^the run took more than its limit of real time$/,
  memoryLimit: /^the processes of the run took more than their limit of memory$/,
  processesLimit: /^the run started more processes than it may$/,
  writtenLimit: /^the actions of the run wrote more than they may$/,
  signalIn: /^the process of the run ended with (?<signal>SIG\w+) in (?<place>.+)$/,
  signal: /^the process of the run ended with (?<signal>SIG\w+)$/,
  status: /^the process of the run ended by itself with status (?<status>\d+)$/,
  actionsSignal: /^the process of the actions ended with (?<signal>SIG\w+)$/,
  actionsStatus: /^the process of the actions ended by itself with status (?<status>\d+)$/,
  actionsClosed: /^the process of the actions has closed its link$/,
  actionsOutOfTurn: /^the process of the actions sent a message out of turn$/,
  sealedNavigation: /^a sealed run has no navigation, and the actions use (?<name>\S+)$/,
  noPlace: /^(?<address>\S+): no free place in (?<times>\d+) attempts$/,
  workerLost: /^its worker was lost (?<times>\d+) times$/,
  undecided: /^the run ended before it was decided$/,
  noWorld: /^project\.json:1:1: a project without a simulated world \(universe none\) cannot be evaluated$/,
  // Of results from before launch nodes were left out.
  launchFiles:
    /^(?<file>\S+):1:1: a project with launch files cannot be evaluated: its nodes run in real time$/,
  launchNode:
    /^(?<place>\S+): the launch node (?<name>.+) is left out: it runs in real time, and this run in simulated time$/,
  noRobot: /^(?<file>\S+):1:1: the world has no robot, so there is nothing to judge$/,
  treeAlone:
    /^(?<file>\S+):1:1: the judge asks for the result of the tree alone, which sealed actions only claim \(.+\)$/,
  outcomesFull:
    /^The outcomes of this project's evaluations take (?<used>.+) of (?<limit>\S+ \wB)\. What is done is kept\. .+$/,
  noOutcome: /^Some runs came to no outcome\.$/,
  replaced: /^Another evaluation took the place of this one\.$/,
  notRecorded: /^The run could not be recorded\.$/,
} as const satisfies Readonly<Record<string, RegExp>>;

export type ReasonKey = keyof typeof PATTERNS;

const KEYS = Object.keys(PATTERNS) as ReasonKey[];

/** Returns what a sentence says; null if it is another one, such as the error of a user's action. */
export function reasonIn(sentence: string): Reason | null {
  for (const key of KEYS) {
    const found = PATTERNS[key].exec(sentence);
    if (found) return { key, values: { ...found.groups } };
  }
  return null;
}
