import { describe, expect, it } from 'vitest';
import i18next from 'i18next';
import { readRobot } from '@/model/robot/read';
import robotUrdf from '@/model/robot/template/robot.urdf?raw';
import robotYaml from '@/model/robot/template/robot.yaml?raw';
import '@/i18n';
import { nameWords, sensorWords } from './naming';

const robot = readRobot(robotYaml, robotUrdf).robot!;
const t = i18next.getFixedT('en', 'robotEditor');
const BAD = 'Letters, digits and _ only; the first is a letter';

describe('nameWords', () => {
  it('reports why a link or a joint cannot have a name', () => {
    const problem = nameWords(robot, 'link', 'base_link', t);
    expect(problem('chassis')).toBeNull();
    expect(problem('base_link')).toBeNull();
    expect(problem('my link')).toBe(BAD);
    expect(problem('caster_link')).toBe('The name caster_link is used twice');
    expect(nameWords(robot, 'joint', 'caster_joint', t)('laser_joint')).toBe(
      'The name laser_joint is used twice',
    );
  });
});

describe('sensorWords', () => {
  const problem = sensorWords(robot, robot.sensors[0]!, t);

  it.each(['front', 'Front_2', 'scan', 'a'.repeat(80)])('accepts %s', (name) => {
    expect(problem(name)).toBeNull();
  });

  it.each(['', '2nd', '_scan', 'front scan', 'a'.repeat(81)])('refuses %s', (name) => {
    expect(problem(name)).toBe(BAD);
  });

  it('refuses the name of another sensor', () => {
    expect(problem('camera')).toBe('The name camera is used twice');
  });
});
