import type { TFunction } from 'i18next';
import { nameProblem, type Named } from '@/model/robot/names';
import type { Robot, Sensor } from '@/model/robot/types';

/**
 * Returns a function that gives the reason why a link's or a joint's name is invalid; `t` translates in the
 * namespace `robotEditor`.
 */
export const nameWords =
  (robot: Robot, what: Named, now: string, t: TFunction<'robotEditor'>) =>
  (wish: string): string | null => {
    const problem = nameProblem(robot, what, now, wish);
    if (problem === null) return null;
    return problem === 'form' ? t('badName') : t('editor3d:problem.sameId', { id: wish });
  };

/** Returns a function that gives the reason why a sensor's name is invalid. */
export const sensorWords =
  (robot: Robot, sensor: Sensor, t: TFunction<'robotEditor'>) =>
  (wish: string): string | null => {
    if (!/^[A-Za-z][A-Za-z0-9_]{0,79}$/.test(wish)) return t('badName');
    const isTaken = robot.sensors.some(({ name, index }) => name === wish && index !== sensor.index);
    return isTaken ? t('editor3d:problem.sameId', { id: wish }) : null;
  };
