import type {
  Fault,
  Held,
  HeldInPython,
  NodeStatus,
  ServerMessage,
  Snapshot,
  Tick,
  Tree,
} from '@/generated/messages';
import { useLiveStore } from '@/store/project/live';
import { useStatusRate } from './statusRate';

const pending = new Map<number, NodeStatus>();
const flashes = new Map<number, NodeStatus>();
let past: Tick['past'] | null = null;
/** The statuses before a held tick, to which the changes of that tick refer; null while none is held. */
let beforeHold: ReadonlyMap<number, NodeStatus> | null = null;
let shownAt = 0;
let timer: ReturnType<typeof setTimeout> | undefined;

/** Passes events about blocks to the canvas: statuses at the rate that the user chose, others at once. */
export function feedLive({ command, data }: ServerMessage): void {
  const live = useLiveStore.getState();
  switch (command) {
    case 'tree':
      forgetPending();
      beforeHold = null;
      return live.setTree((data as Tree).nodes);
    case 'snapshot': {
      forgetPending();
      const snapshot = data as Snapshot;
      live.setTree(snapshot.tree?.nodes ?? []);
      live.setStatuses(snapshot.statuses);
      beforeHold = null;
      const held = snapshot.held ?? snapshot.held_in_python;
      if (held) feedLive({ id: '', command: 'held', data: held, seq: 0, t: 0 });
      live.setPast(snapshot.past);
      return snapshot.faults.forEach(showFault);
    }
    case 'tick': {
      // The tick ends: its changes refer to the statuses before it.
      if (beforeHold) feedLive({ id: '', command: 'released', data: { off: false }, seq: 0, t: 0 });
      const { changed, flashed } = data as Tick;
      past = (data as Tick).past;
      for (const [uid, status] of changed) pending.set(uid, status);
      for (const [uid, status] of flashed) flashes.set(uid, status);
      return;
    }
    case 'held':
    case 'held_in_python': {
      showStatuses();
      const { statuses } = data as Held | HeldInPython;
      const now = new Map<number, NodeStatus>(statuses);
      beforeHold ??= new Map(live.uidStatuses());
      return live.setStatuses(
        [...new Set([...now.keys(), ...live.uidStatuses().keys()])].map((uid) => [
          uid,
          now.get(uid) ?? 'IDLE',
        ]),
      );
    }
    case 'released': {
      if (beforeHold)
        live.setStatuses([...live.uidStatuses().keys()].map((uid) => [uid, beforeHold?.get(uid) ?? 'IDLE']));
      beforeHold = null;
      return;
    }
    // A stopped tree shows its last statuses at once, without the delay of the rate.
    case 'state-changed':
      return showStatuses();
    case 'fault':
      return showFault(data as Fault);
  }
}

/** Shows the collected statuses, at once or when the rate allows it; called after each batch of messages. */
export function showDueStatuses(): void {
  if (pending.size === 0 && flashes.size === 0 && past === null) return;
  const { hz } = useStatusRate.getState();
  const wait = hz > 0 ? 1000 / hz - (performance.now() - shownAt) : 0;
  if (wait <= 1) return showStatuses();
  timer ??= setTimeout(showStatuses, wait);
}

function showStatuses(): void {
  clearTimeout(timer);
  timer = undefined;
  shownAt = performance.now();
  const live = useLiveStore.getState();
  if (pending.size > 0) live.setStatuses([...pending]);
  if (past !== null) live.setPast(past);
  if (flashes.size > 0) live.flash([...flashes]);
  forgetPending();
}

export function forgetPending(): void {
  clearTimeout(timer);
  timer = undefined;
  pending.clear();
  flashes.clear();
  past = null;
}

function showFault(fault: Fault): void {
  if (fault.node_id) useLiveStore.getState().setFault(fault.node_id, fault.tree_id, fault.message);
}
