import { create } from 'zustand';
import { setPort } from '@/model/edits';
import type { PortSpec } from '@/model/ports';
import { specOf } from '@/model/vocabulary';
import { t as text } from '@/i18n';
import { useProjectStore } from '@/store/project';
import { reported } from '@/store/run/commands';
import { send } from '@/store/session/connection';
import {
  beginJob,
  changeJob,
  useTries,
  type TriedMoment,
  type TriedPlace,
  type TriesJob,
} from '@/store/session/tries';
import { hueOf, showPaths, type ShownPath } from '@/store/session/trace/shownPaths';
import { beginsAgain, canGoBack } from './goBack';
import { newJob, refusalOf } from './job';
import { extent, lookNow } from '../looking';
import { useMoment } from '../store';

/** A block whose ports can be tried. */
export interface TriedBlock {
  readonly uid: number;
  readonly treeId: string;
  readonly nodeId: string;
  readonly path: string;
  readonly ports: readonly PortSpec[];
  readonly values: Readonly<Record<string, string>>;
}

interface Asking {
  readonly run: string;
  readonly t: number;
  readonly blocks: readonly TriedBlock[];
  /** The number of the block that is chosen first. */
  readonly uid: number | null;
}

/** The open dialog; null while it is closed. */
export const useTryMany = create<{ readonly asking: Asking | null }>(() => ({ asking: null }));

/** Whether values can be tried from the shown moment: of an exact run, by the driver. */
export const canTry = (): boolean => canGoBack() && !beginsAgain();

/** Opens the dialog for the shown moment; `uid` is the selected block. */
export function askTries(uid: number | null): void {
  const { t, tree } = useMoment.getState();
  const run = extent()?.run;
  if (t === null || run === undefined || !canTry()) return;
  const { diagrams, vocabulary } = useProjectStore.getState();
  const blocks = tree.flatMap((each): TriedBlock[] => {
    const node = diagrams[each.tree_id]?.nodes[each.node_id];
    if (node?.type !== each.type) return [];
    const ports = (specOf(vocabulary, node)?.ports ?? []).filter(({ direction }) => direction !== 'output');
    const { uid: number, tree_id: treeId, node_id: nodeId, path } = each;
    return ports.length > 0 ? [{ uid: number, treeId, nodeId, path, ports, values: node.ports ?? {} }] : [];
  });
  const chosen = blocks.find((block) => block.uid === uid) ?? blocks[0];
  useTryMany.setState({ asking: { run, t, blocks, uid: chosen?.uid ?? null } });
}

export const closeTries = () => useTryMany.setState({ asking: null });

/** Begins to try values; what comes of it is in `useTries`. */
export const beginTries = (place: TriedPlace, values: readonly string[], durationS: number): Promise<void> =>
  begun(place, values, (job) => {
    const { run, t, nodeId, path, port } = place;
    const order = { job, run, t, path, port, node_id: nodeId, values: [...values], duration_s: durationS };
    return send('try_values', order);
  });

/** Begins to try seeds, in the same way. */
export const beginSeeds = (at: TriedMoment, seeds: readonly string[], durationS: number): Promise<void> =>
  begun(at, seeds, (job) =>
    send('try_seeds', { job, run: at.run, t: at.t, seeds: seeds.map(Number), duration_s: durationS }),
  );

async function begun(
  at: TriedMoment | TriedPlace,
  values: readonly string[],
  ask: (job: string) => Promise<unknown>,
): Promise<void> {
  const job = newJob();
  beginJob(job, at, values);
  try {
    await ask(job);
  } catch (error) {
    changeJob(job, () => ({ ended: { job, end: 'refused', message: refusalOf(error) } }));
  }
}

/** Ends the job that runs. */
export function stopTries(): void {
  const { job } = useTries.getState();
  if (job && job.ended === null) void reported(send('stop_trying', { job: job.id }));
}

/** Takes the run of the session back to the moment, gives the port the value, and lets it run on. */
export async function openAsBranch({ moment: { run, t }, place }: TriesJob, value: string | null) {
  closeTries();
  lookNow();
  const doing = async () => {
    await send('go_back', { run, t });
    if (value !== null && place) {
      const { nodeId, path, port } = place;
      await send('set_port', { node_id: nodeId, path, port, value });
    }
    await send('resume', {});
  };
  await reported(doing());
}

/** Draws the chosen paths in 3D, and closes the dialog. */
export function drawTries({ outcomes, values, hidden, place }: TriesJob): void {
  closeTries();
  const chosen = outcomes.filter(
    ({ index, paths }) => !hidden.includes(index) && Object.keys(paths).length > 0,
  );
  showPaths(
    'tries',
    chosen.map(({ index, paths }): ShownPath => {
      const value = values[index - 1] ?? '';
      const name =
        index === 0
          ? text('axis:tries.asItIs')
          : place
            ? text('axis:tries.pathOf', { port: place.port, value })
            : text('axis:tries.pathOfSeed', { value });
      const lines = Object.values(paths).map((path) =>
        Float32Array.from(path.flatMap(([t, x, y], at) => [x, y, t, at === 0 ? 1 : 0])),
      );
      return { label: String(index), name, hue: hueOf(index), isDashed: index === 0, labelAt: 'end', lines };
    }),
  );
}

/** Whether the block is still there to take a value. */
export const canUse = ({ treeId, nodeId }: TriedPlace): boolean =>
  useProjectStore.getState().diagrams[treeId]?.nodes[nodeId] !== undefined;

/** Writes a value into the tree, as an edit that can be undone. */
export function writeValue({ treeId, nodeId, port }: TriedPlace, value: string): void {
  const { apply } = useProjectStore.getState();
  lookNow();
  apply(treeId, text('axis:tries.edit', { port }), [setPort(nodeId, port, value)]);
}
