import { describe, expect, it } from 'vitest';
import { parseXml } from '../document/xml';
import { readUrdf } from './urdf';

const robot = (type: string, inside: string) =>
  `<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="${type}">` +
  `<parent link="a"/><child link="b"/>${inside}</joint></robot>`;
const LIMIT = '<limit lower="-1" upper="1" effort="1" velocity="1"/>';

const read = (text: string) => readUrdf(parseXml(text));

describe('joints', () => {
  it.each(['0 3 4', '0 0.3 0.4', '0 30 40'])('have an axis of length 1 by %s', (axis) => {
    const joint = read(robot('continuous', `<axis xyz="${axis}"/>`)).urdf?.joints.get('j');
    expect(joint?.axis).toEqual([0, expect.closeTo(0.6), expect.closeTo(0.8)]);
    expect(joint?.writtenAxis).toEqual(axis.split(' ').map(Number));
  });

  it.each([
    ['continuous', '<axis xyz="0 0 0"/>', 'noAxis'],
    ['revolute', '', 'noLimit'],
    ['prismatic', '', 'noLimit'],
    ['floating', '', 'jointType'],
    ['revolute', LIMIT.replace(' effort="1"', ''), 'jointNeeds'],
    ['continuous', '<limit effort="1"/>', 'jointNeeds'],
    ['revolute', `${LIMIT}<safety_controller/>`, 'jointNeeds'],
    ['revolute', LIMIT.replace('"-1"', '"2"'), 'limitOrder'],
  ])('that are %s with %s are refused: %s', (type, inside, kind) => {
    const { issues } = read(robot(type, inside));
    expect(issues.map((issue) => [issue.kind, issue.params['joint']])).toEqual([[kind, 'j']]);
  });

  it('that are well written have no issues', () => {
    expect(read(robot('fixed', '<axis xyz="0 0 0"/>')).issues).toEqual([]);
    expect(read(robot('revolute', `${LIMIT}<safety_controller k_velocity="1"/>`)).issues).toEqual([]);
  });
});
