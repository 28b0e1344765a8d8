import { describe, expect, it } from 'vitest';
import {
  directionIn,
  directionOf,
  fieldLabel,
  fieldPort,
  firstValue,
  fullName,
  isRosName,
  shortLabel,
  typePortOf,
} from './rosFields';

const field = (port: string, type: string, direction: 'input' | 'output' = 'input') => ({
  port,
  direction,
  type,
  ros: type,
});

describe('the ports of ROS blocks', () => {
  it('include one for the type', () => {
    expect(typePortOf('RosAction')).toEqual({ port: 'action_type', kind: 'action' });
    expect(typePortOf('Sequence')).toBeNull();
  });

  it('name interfaces in both spellings', () => {
    expect(fullName('std_srvs/Trigger', 'srv')).toBe('std_srvs/srv/Trigger');
    expect(fullName(' std_srvs/srv/Trigger', 'srv')).toBe('std_srvs/srv/Trigger');
    expect(fullName('std_srvs/msg/Trigger', 'srv')).toBeNull();
    expect(fullName('{type}', 'srv')).toBeNull();
  });

  it('show the path of a field', () => {
    expect(fieldLabel('goal__pose__pose__position__x')).toBe('goal.pose.pose.position.x');
    expect(shortLabel('goal__pose__pose__position__x')).toBe('position.x');
  });

  it('have the field’s type and direction', () => {
    expect(fieldPort('RosAction', field('goal__order', 'int'))).toMatchObject({
      name: 'goal__order',
      type: 'int',
      direction: 'input',
    });
    expect(directionIn('RosSubscribe', field('message__x', 'double'))).toBe('output');
    expect(directionIn('RosPublish', field('message__x', 'double'))).toBe('input');
  });

  it('have a direction by their names', () => {
    expect(directionOf('RosAction', 'feedback__x')).toBe('output');
    expect(directionOf('RosAction', 'goal__x')).toBe('input');
    expect(directionOf('RosSubscribe', 'message__x')).toBe('output');
    expect(directionOf('RosPublish', 'message')).toBe('input');
  });

  it('start with ROS’s default, or with a key', () => {
    expect(firstValue('RosAction', field('goal__order', 'int'))).toBe('0');
    expect(firstValue('RosAction', field('goal__frame', 'string'))).toBe('');
    expect(firstValue('RosAction', field('goal__pose', 'any'))).toBe('{pose}');
    expect(firstValue('RosAction', field('result__code', 'uint', 'output'))).toBe('{code}');
    expect(firstValue('RosSubscribe', field('message__percentage', 'double'))).toBe('{percentage}');
  });
});

it.each([
  ['/cmd_vel', true],
  ['cmd_vel', true],
  ['~/status', true],
  ['~', true],
  ['/a/b_2', true],
  ['', false],
  ['/', false],
  ['~/', false],
  ['7', false],
  ['/a//b', false],
  ['/a/', false],
  ['cmd vel', false],
  ['ñ', false],
])('says whether %o is a name of ROS', (name, isName) => {
  expect(isRosName(name)).toBe(isName);
});
