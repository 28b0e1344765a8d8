import type { Pose, Vector } from './values';

/* Readers of values: each returns the value if it has the expected type, and otherwise the fallback. */

export const number = (value: unknown, fallback: number): number =>
  typeof value === 'number' && Number.isFinite(value) ? value : fallback;
export const text = (value: unknown, fallback: string): string =>
  typeof value === 'string' ? value : fallback;
export const flag = (value: unknown, fallback: boolean): boolean =>
  typeof value === 'boolean' ? value : fallback;
export const color = (value: unknown, fallback: string): string =>
  typeof value === 'string' && /^#[0-9a-fA-F]{6}([0-9a-fA-F]{2})?$/.test(value) ? value : fallback;

export function numbers(value: unknown, fallback: readonly number[]): readonly number[] {
  const isRight = Array.isArray(value) && value.length === fallback.length;
  return isRight && value.every((part) => typeof part === 'number' && Number.isFinite(part))
    ? (value as number[])
    : fallback;
}

export const vector = (value: unknown, fallback: Vector) => numbers(value, fallback) as Vector;
export const pose = (value: unknown) => numbers(value, [0, 0, 0, 0, 0, 0]) as Pose;
