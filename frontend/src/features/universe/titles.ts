import type { TFunction } from 'i18next';
import type { UniverseInfo } from '@/api/types';

/** The choice to run against an outside ROS graph, without a simulated world. */
export const OUTSIDE = 'none';

type Kind = 'universe' | 'robot';

/**
 * Returns a built-in universe or robot with its title in the current language; `t` translates in the
 * namespace `worlds`.
 */
export function titled(t: TFunction, kind: Kind, info: UniverseInfo): UniverseInfo {
  return {
    ...info,
    name: t(`${kind}.${info.id}.name`, { defaultValue: info.name }),
    description: t(`${kind}.${info.id}.description`, { defaultValue: info.description ?? '' }),
  };
}
