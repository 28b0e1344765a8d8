import { screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { partOf } from '@/model/robot/types';
import robotYaml from '@/model/robot/template/robot.yaml?raw';
import { openRobot, ROBOT, showRobot, type, write } from '../../../harness/documents';
import { user } from '../../../harness/testing';
import { PartFields } from './PartFields';

function fields(key: string, texts: Record<string, string> = {}) {
  const editor = openRobot(texts);
  let now = key;
  const robot = showRobot(editor, (shown) => {
    now = partOf(shown, now)?.key ?? editor.store.getState().selection[0] ?? '';
    const part = partOf(shown, now);
    return part ? <PartFields editor={editor} robot={shown} part={part} /> : null;
  });
  return { editor, robot, part: () => partOf(robot(), now)! };
}

describe('the fields of a part', () => {
  it('of the base: a body, but no pose and no joint', () => {
    fields('link base_link');
    expect(screen.getByTestId('part-fields')).toHaveAttribute('data-part', 'link base_link');
    expect(screen.getByRole('textbox', { name: 'Name · Base' })).toHaveValue('base_link');
    expect(screen.getByTestId('part-mass')).toBeInTheDocument();
    expect(screen.queryByTestId('field-x')).toBeNull();
    expect(screen.queryByTestId('joint')).toBeNull();
    expect(screen.queryByTestId('wheel-radius')).toBeNull();
  });

  it('of a wheel: those of all wheels, without sizes of single shapes', () => {
    fields('link wheel_left_link');
    expect(screen.getByRole('textbox', { name: 'Name · Driven wheel' })).toBeInTheDocument();
    expect(screen.getByTestId('wheel-radius')).toBeInTheDocument();
    expect(screen.queryByTestId('shape-0')).toBeNull();
    expect(screen.getByTestId('joint')).toBeInTheDocument();
  });

  it('of a sensor: its values, its pose, and its body', async () => {
    const { robot } = fields('sensor scan');
    expect(screen.getByRole('textbox', { name: 'Name · LIDAR' })).toHaveValue('scan');
    await write('value-range_max', '5');
    expect(robot().sensors[0]?.raw['range_max']).toBe(5);
    expect(screen.getByTestId('shape-0')).toBeInTheDocument();
    await write('field-z', '0.3');
    expect(partOf(robot(), 'sensor scan')?.pose[2]).toBeCloseTo(0.3);
  });

  it('of a sensor on the base: no body, which is that of the base', () => {
    const imu = `${robotYaml}  - {name: imu, kind: imu, link: base_link, topic: /imu, rate_hz: 30}\n`;
    fields('sensor imu', { [ROBOT]: imu });
    expect(screen.queryByTestId('part-mass')).toBeNull();
    expect(screen.queryByTestId('field-x')).toBeNull();
    expect(screen.getByTestId('value-rate_hz')).toBeInTheDocument();
  });

  it('rename a sensor, or refuse its name', async () => {
    const { robot } = fields('sensor scan');
    await type('part-name', 'camera');
    expect(screen.getByText('The name camera is used twice')).toBeInTheDocument();
    await write('part-name', 'front');
    expect(robot().sensors.map(({ name }) => name)).toEqual(['front', 'camera']);
  });

  it('rename a link, or refuse its name', async () => {
    const { robot } = fields('link caster_link');
    await type('part-name', 'laser_link');
    expect(screen.getByText('The name laser_link is used twice')).toBeInTheDocument();
    await write('part-name', 'rear');
    expect(robot().urdf.links.has('rear')).toBe(true);
    expect(robot().urdf.links.has('caster_link')).toBe(false);
  });

  it('step the position by the grid, or by a millimetre', async () => {
    const { editor, part } = fields('link caster_link');
    const start = part().pose[0];
    await user.type(screen.getByTestId('field-x'), '{ArrowUp}');
    expect(part().pose[0]).toBeCloseTo(start + 0.005);
    editor.store.setState({ grid: 0 });
    await user.type(screen.getByTestId('field-x'), '{ArrowUp}');
    expect(part().pose[0]).toBeCloseTo(start + 0.006);
  });
});
