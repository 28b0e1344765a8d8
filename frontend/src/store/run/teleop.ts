import { create } from 'zustand';
import { isLookingBack } from '@/store/moment/store';
import { send } from '@/store/session/connection';
import { useSessionStore } from '@/store/session/store';

export interface Direction {
  /** 1 is forward, -1 backward. */
  linear: number;
  /** 1 is left, -1 right. */
  angular: number;
}

interface TeleopData {
  isOn: boolean;
  /** The speeds while a key is held, in m/s and rad/s. */
  linear: number;
  angular: number;
  direction: Direction;
}

/** The period of repeated commands: the world drops a command after a while, so a held key sends it again. */
const REPEAT_MS = 100;
const STILL: Direction = { linear: 0, angular: 0 };

export const useTeleop = create<TeleopData>(() => ({
  isOn: false,
  linear: 0.3,
  angular: 1,
  direction: STILL,
}));

let repeating: ReturnType<typeof setInterval> | undefined;

/**
 * Returns whether the user can drive the robot by hand. Time must pass: while a run is paused, the world is
 * frozen.
 */
export function canDrive(): boolean {
  const { executor, introspection } = useSessionStore.getState();
  return (
    !['idle', 'connected', 'paused', 'held'].includes(executor) &&
    introspection?.role !== 'viewer' &&
    !isLookingBack()
  );
}

/** Drives in a direction until another one, or none, is set. */
export function drive(direction: Direction): void {
  const before = useTeleop.getState().direction;
  if (before.linear === direction.linear && before.angular === direction.angular) return;
  useTeleop.setState({ direction });
  clearInterval(repeating);
  repeating = undefined;
  command();
  if (direction.linear !== 0 || direction.angular !== 0) repeating = setInterval(command, REPEAT_MS);
}

export const halt = () => drive(STILL);

export function setDriving(isOn: boolean): void {
  halt();
  useTeleop.setState({ isOn });
}

function command(): void {
  const { direction, linear, angular } = useTeleop.getState();
  send('teleop', { linear: direction.linear * linear, angular: direction.angular * angular }).catch(() => {
    clearInterval(repeating);
  });
}
