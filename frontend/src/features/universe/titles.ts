import type { TFunction } from 'i18next';
import type { UniverseInfo } from '@/api/types';

/** Runs against an outside ROS graph, without a simulated world. */
export const OUTSIDE = 'none';

type Kind = 'universe' | 'robot';

/** A universe or a robot that we ship, in the language of the page; `t` is that of `worlds`. */
export function titled(t: TFunction, kind: Kind, info: UniverseInfo): UniverseInfo {
  return {
    ...info,
    name: t(`${kind}.${info.id}.name`, { defaultValue: info.name }),
    description: t(`${kind}.${info.id}.description`, { defaultValue: info.description ?? '' }),
  };
}
