import { freshId } from '@/model/diagram';
import { addNode, setPort } from '@/model/edits';
import type { PortSpec } from '@/model/ports';
import { parseDiagram } from '@/model/serialize';
import { treeFacts } from '@/model/treeFacts';
import { atPlaces, closureOf, nameIn, type Insertion, type Sources } from '@/model/reuse';
import { bestPlacement } from '@/model/rules';
import { planHere, type Delivery } from './bringing';
import { activeDiagram, change } from './edits/blocks';
import { useProjectStore } from './index';
import { treePath } from './state';

/** A behaviour that can be reused: from the built-in library, or a tree of another project. */
export interface Reusable {
  /** The name of the behaviour's tree. */
  readonly id: string;
  /** `library`, or the id of the project that the tree belongs to. */
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

/** The file in which a project records its reused behaviours and their versions. */
const RECORD = 'assets/library.json';
const FORMAT = 'bt-studio/taken';

const keyOf = ({ source, id }: Pick<Reusable, 'source' | 'id'>) => `${source}/${id}`;

function isTaken(value: unknown): value is Taken {
  const { source, version, places } = (value ?? {}) as Partial<Taken>;
  return typeof source === 'string' && typeof version === 'string' && typeof places === 'object';
}

/** Returns the record in a project; an unreadable record counts as empty. */
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

/** Returns the text of the record with one more behaviour. */
function recordWith(behaviour: Reusable, places: Taken['places']): string {
  const { source, version } = behaviour;
  const behaviours = { ...takenNow(), [keyOf(behaviour)]: { source, version, places } };
  return `${JSON.stringify({ format: FORMAT, version: 1, behaviours }, null, 2)}\n`;
}

function write(path: string, text: string): void {
  const { files, addFile, setFileText } = useProjectStore.getState();
  if (path in files) setFileText(path, text);
  else addFile(path, text);
}

/** Returns the ports that a tree has as a SubTree. */
function portsOf(text: string | undefined): readonly PortSpec[] {
  return text === undefined ? [] : treeFacts(parseDiagram(text)).ports;
}

/** Returns the files that a behaviour adds to a project. */
export const deliveryOf = ({ id, files }: Reusable): Delivery => ({ needs: [treePath(id)], sources: files });

/**
 * Adds a behaviour to the project and to the active tree, as one step of undo; returns its name in the project.
 */
export function insertBehaviour(
  behaviour: Reusable,
  plan: Insertion = planHere(deliveryOf(behaviour)),
): string {
  const { selection, vocabulary } = useProjectStore.getState();
  const tree = nameIn(plan.places[treePath(behaviour.id)] ?? treePath(behaviour.id));
  const files = { ...plan.files, [RECORD]: recordWith(behaviour, plan.places) };
  const diagram = activeDiagram();
  if (!diagram) {
    for (const [path, text] of Object.entries(files)) write(path, text);
    return tree;
  }
  const node = freshId(diagram.nodes);
  const place = bestPlacement(diagram, selection[0], vocabulary);
  const values = portsOf(behaviour.files[treePath(behaviour.id)]).map((port) =>
    setPort(node, port.name, port.direction === 'output' ? `{${port.name}}` : (port.default ?? '')),
  );
  change('add', [addNode(node, { type: 'SubTree', tree }, place), ...values], { select: [node], files });
  return tree;
}

/** A file of a behaviour: its text in the project, and in the newest version. */
export interface Difference {
  readonly path: string;
  readonly mine: string;
  readonly theirs: string;
}

/** Returns the files of a project that an update concerns. */
export function placesOf(behaviour: Reusable): readonly string[] {
  const taken = takenNow()[keyOf(behaviour)];
  return taken ? Object.keys(atPlaces(behaviour.files, taken.places)) : [];
}

/** Returns the changes of an update; empty if the project has the newest version. */
export function differencesOf(behaviour: Reusable): readonly Difference[] {
  const taken = takenNow()[keyOf(behaviour)];
  if (!taken) return [];
  const { currentText } = useProjectStore.getState();
  return Object.entries(atPlaces(behaviour.files, taken.places))
    .map(([path, theirs]) => ({ path, mine: currentText(path) ?? '', theirs }))
    .filter(({ mine, theirs }) => mine !== theirs);
}

/**
 * Updates a behaviour to the newest version with an ordinary save, so that the history keeps the old version.
 */
export function updateBehaviour(behaviour: Reusable): void {
  for (const { path, theirs } of differencesOf(behaviour)) write(path, theirs);
  write(RECORD, recordWith(behaviour, takenNow()[keyOf(behaviour)]?.places ?? {}));
}

/** Returns the trees of a project as reusable behaviours, its main tree included. */
export function reusablesOf(project: string, revision: number, files: Sources): readonly Reusable[] {
  return Object.keys(files)
    .map((path) => /^trees\/([^/]+)\.json$/.exec(path)?.[1])
    .filter((id): id is string => id !== undefined)
    .flatMap((id) => {
      try {
        return [{ id, source: project, version: `r${revision}`, files: closureOf([treePath(id)], files) }];
      } catch {
        // An unreadable tree cannot be reused.
        return [];
      }
    });
}
