import { differInPortsOnly, portChanges, withPorts, type PortChange } from '@/model/portChanges';
import { useProjectStore } from '@/store/project';
import { liveKey } from '@/store/project/live';
import type { ProjectState } from '@/store/project/state';
import { send } from '@/store/session/connection';
import { CommandError } from '@/store/session/control';
import { flush, useSessionStore } from '@/store/session/store';
import { beginProgram, noteRefusal, useLivePorts } from './livePorts';
import { useRunStore } from './store';

/**
 * Sends the port changes of this page, including undo and redo, to the running program, which applies them at
 * its next tick. Edits of other users take effect in the next run, so that nobody else moves this robot.
 */
export function followPorts(): () => void {
  const stops = [
    useProjectStore.subscribe(onProject),
    useLivePorts.subscribe((now, before) => {
      if (before.isTyping && !now.isTyping) void sendChanges();
    }),
    useSessionStore.subscribe((now, before) => {
      // What a program refused or kept is gone with its session.
      if (now.sessionId === null && before.sessionId !== null) beginProgram(null);
      if (now.executor !== before.executor) void sendChanges();
    }),
    useRunStore.subscribe((now, before) => {
      if (now.stage === null && before.stage !== null) void sendChanges();
    }),
  ];
  return () => stops.forEach((stop) => stop());
}

function onProject(now: ProjectState, before: ProjectState): void {
  if (now.projectId !== before.projectId) return beginProgram(null);
  const isEdit = now.changeCounter !== before.changeCounter;
  if (isEdit) noteEdit(now, before);
  if (now.diagrams === before.diagrams) return;
  const program = useLivePorts.getState().program ?? before.diagrams;
  if (isEdit) {
    useLivePorts.setState({ program });
    void sendChanges();
  } else {
    const theirs = portChanges(before.diagrams, now.diagrams);
    useLivePorts.setState({ program: withPorts(program, theirs) });
  }
}

/** Extends the series of edits that change ports only. */
function noteEdit(now: ProjectState, before: ProjectState): void {
  const isInStep = [useRunStore.getState().ranAt, useLivePorts.getState().portsOnlyUntil].includes(
    before.changeCounter,
  );
  const isOfPorts =
    now.files === before.files &&
    now.settings === before.settings &&
    now.mainTree === before.mainTree &&
    differInPortsOnly(before.diagrams, now.diagrams);
  if (isInStep && isOfPorts) useLivePorts.setState({ portsOnlyUntil: now.changeCounter });
}

function canSend(): boolean {
  const { executor, introspection, connection } = useSessionStore.getState();
  const hasApplication = executor === 'application_running' || executor === 'paused';
  const isDriver = connection === 'open' && introspection?.role === 'driver';
  return hasApplication && isDriver && useRunStore.getState().stage === null;
}

async function sendChanges(): Promise<void> {
  const { program, isTyping } = useLivePorts.getState();
  if (program === null || isTyping || !canSend()) return;
  const { diagrams } = useProjectStore.getState();
  const changes = portChanges(program, diagrams);
  useLivePorts.setState({ program: diagrams });
  const areTaken = await Promise.all(changes.map(sendChange));
  flush(); // This applies the events that arrived before the replies.
  if (areTaken.every(Boolean) && isInStep())
    useRunStore.setState({ ranAt: useProjectStore.getState().changeCounter });
}

/** Sends a port to every instance of its block; resolves to true if all accepted it. */
async function sendChange({ tree, node, port, before, value }: PortChange): Promise<boolean> {
  const key = liveKey(tree, node);
  const instances = useSessionStore
    .getState()
    .tree.filter(({ tree_id, node_id }) => tree_id === tree && node_id === node);
  try {
    await Promise.all(instances.map(({ path }) => send('set_port', { node_id: node, path, port, value })));
    noteRefusal(key, port, null);
    return instances.length > 0;
  } catch (error) {
    if (!(error instanceof CommandError)) throw error;
    const { code, message } = error;
    noteRefusal(key, port, { value, before, code, message });
    return false;
  }
}

/** Returns whether the running program equals the project's, so that a restart would change nothing. */
function isInStep(): boolean {
  const { changeCounter, diagrams } = useProjectStore.getState();
  if (useLivePorts.getState().portsOnlyUntil !== changeCounter) return false;
  const textOf = (tree: string, node: string, port: string) =>
    diagrams[tree]?.nodes[node]?.ports?.[port] ?? null;
  const isRefused = Object.entries(useLivePorts.getState().refused).some(([key, ports]) => {
    const [tree = '', node = ''] = key.split('/');
    return Object.entries(ports).some(([port, { value }]) => value === textOf(tree, node, port));
  });
  const waits = Object.values(useSessionStore.getState().ports).some(
    ({ tree_id, node_id, port, value, saved, effect }) =>
      effect === 'next_start' && value !== saved && value === textOf(tree_id, node_id, port),
  );
  return !isRefused && !waits;
}
