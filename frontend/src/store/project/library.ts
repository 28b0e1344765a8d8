import { setPort } from '@/model/edits';
import type { PortSpec } from '@/model/ports';
import { parseDiagram } from '@/model/serialize';
import { treeFacts } from '@/model/treeFacts';
import { atPlaces, closureOf, planInsertion, type Sources } from '@/model/reuse';
import { addHere, change } from './edits/blocks';
import { useProjectStore } from './index';

/** A behaviour that can be reused: of the built-in library, or a tree of another project. */
export interface Reusable {
  /** The name of its tree. */
  readonly id: string;
  /** `library`, or the id of the project that it comes from. */
  readonly source: string;
  readonly version: string;
  readonly files: Sources;
}

/** The record of a behaviour that a project has reused. */
export interface Taken {
  readonly source: string;
  readonly version: string;
  readonly places: Readonly<Record<string, string>>;
}

/** Where a project remembers which behaviours it took over, in which versions. */
const RECORD = 'assets/library.json';
const FORMAT = 'bt-studio/taken';

const keyOf = ({ source, id }: Pick<Reusable, 'source' | 'id'>) => `${source}/${id}`;

function isTaken(value: unknown): value is Taken {
  const { source, version, places } = (value ?? {}) as Partial<Taken>;
  return typeof source === 'string' && typeof version === 'string' && typeof places === 'object';
}

/** The record as it is in the project; what cannot be read counts as never taken. */
export function takenIn(text: string | null): Readonly<Record<string, Taken>> {
  if (text === null) return {};
  try {
    const { behaviours } = JSON.parse(text) as { behaviours?: Record<string, unknown> };
    return Object.fromEntries(
      Object.entries(behaviours ?? {}).filter((row): row is [string, Taken] => isTaken(row[1])),
    );
  } catch {
    return {};
  }
}

export function takenNow(): Readonly<Record<string, Taken>> {
  return takenIn(useProjectStore.getState().currentText(RECORD));
}

function remember(behaviour: Reusable, places: Taken['places']): void {
  const { source, version } = behaviour;
  const behaviours = { ...takenNow(), [keyOf(behaviour)]: { source, version, places } };
  write(RECORD, `${JSON.stringify({ format: FORMAT, version: 1, behaviours }, null, 2)}\n`);
}

function write(path: string, text: string): void {
  const { files, addFile, setFileText } = useProjectStore.getState();
  if (path in files) setFileText(path, text);
  else addFile(path, text);
}

/** The ports of a tree when it is used as a subtree. */
function portsOf(text: string | undefined): readonly PortSpec[] {
  return text === undefined ? [] : treeFacts(parseDiagram(text)).ports;
}

/** Brings a behaviour into the project and hangs it into the active tree; answers its name here. */
export function insertBehaviour(behaviour: Reusable): string {
  const { currentText, diagrams, vocabulary } = useProjectStore.getState();
  const plan = planInsertion(
    behaviour.id,
    behaviour.files,
    currentText,
    (name) => name in diagrams || vocabulary.specs.has(name),
  );
  for (const [path, text] of Object.entries(plan.files)) write(path, text);
  remember(behaviour, plan.places);
  const node = addHere({ type: 'SubTree', tree: plan.tree });
  if (node === null) return plan.tree;
  const values = portsOf(behaviour.files[`trees/${behaviour.id}.json`]).map((port) =>
    setPort(node, port.name, port.direction === 'output' ? `{${port.name}}` : (port.default ?? '')),
  );
  if (values.length > 0) change('add', values, { select: [node] });
  return plan.tree;
}

/** A file of a behaviour as it is in the project, and as the newest version has it. */
export interface Difference {
  readonly path: string;
  readonly mine: string;
  readonly theirs: string;
}

/** The changes of an update; empty when the project has the newest version already. */
export function differencesOf(behaviour: Reusable): readonly Difference[] {
  const taken = takenNow()[keyOf(behaviour)];
  if (!taken) return [];
  const { currentText } = useProjectStore.getState();
  return Object.entries(atPlaces(behaviour.files, taken.places))
    .map(([path, theirs]) => ({ path, mine: currentText(path) ?? '', theirs }))
    .filter(({ mine, theirs }) => mine !== theirs);
}

/** Takes over the newest version: a save like any other, so that the revisions have the one before. */
export function updateBehaviour(behaviour: Reusable): void {
  for (const { path, theirs } of differencesOf(behaviour)) write(path, theirs);
  remember(behaviour, takenNow()[keyOf(behaviour)]?.places ?? {});
}

/** The trees of a project as behaviours to reuse; its main tree is what it is about, and comes too. */
export function reusablesOf(project: string, revision: number, files: Sources): readonly Reusable[] {
  return Object.keys(files)
    .map((path) => /^trees\/([^/]+)\.json$/.exec(path)?.[1])
    .filter((id): id is string => id !== undefined)
    .flatMap((id) => {
      try {
        return [{ id, source: project, version: `r${revision}`, files: closureOf(id, files) }];
      } catch {
        // A tree that cannot be read cannot be reused.
        return [];
      }
    });
}
