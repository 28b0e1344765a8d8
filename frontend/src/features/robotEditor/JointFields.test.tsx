import { screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import robotUrdf from '@/model/robot/template/robot.urdf?raw';
import { motorOf } from '@/model/robot/joints';
import { choose, lookOnly, openRobot, showRobot, type, URDF, write } from '../../../harness/documents';
import { user } from '../../../harness/testing';
import { JointFields } from './JointFields';

const CASTER = '<joint name="caster_joint" type="fixed">';
const asType = (kind: string, more = '') => ({
  [URDF]: robotUrdf.replace(CASTER, `<joint name="caster_joint" type="${kind}"><axis xyz="0 0 1"/>${more}`),
});
const LIMIT = '<limit lower="-1.5707963" upper="0.5" effort="1" velocity="1"/>';

function fields(
  texts: Record<string, string> = {},
  name = 'caster_joint',
  prepare: () => void = () => undefined,
) {
  const editor = openRobot(texts);
  prepare();
  let now = name;
  const robot = showRobot(editor, (shown) => {
    const joint =
      shown.urdf.joints.get(now) ??
      [...shown.urdf.joints.values()].find(({ child }) => child === 'caster_link')!;
    now = joint.name;
    return <JointFields editor={editor} robot={shown} joint={joint} />;
  });
  return { editor, robot, joint: () => robot().urdf.joints.get(now)! };
}

describe('the fields of a joint', () => {
  it('show how it moves, and are closed for a fixed joint', () => {
    fields();
    const details = screen.getByTestId('joint');
    expect(details).not.toHaveAttribute('open');
    expect(screen.getByText('Joint · fixed')).toBeInTheDocument();
    expect(screen.queryByTestId('joint-motor')).toBeNull();
    expect(screen.queryByTestId('joint-axis-x')).toBeNull();
  });

  it('rename it, and refuse a taken name', async () => {
    const { joint } = fields();
    await type('joint-name', 'laser_joint');
    expect(screen.getByText('The name laser_joint is used twice')).toBeInTheDocument();
    await user.keyboard('{Enter}');
    expect(joint().name).toBe('caster_joint');
    await write('joint-name', 'hinge');
    expect(joint().name).toBe('hinge');
  });

  it('make it turn, and then show its axis and its limits in degrees', async () => {
    const { joint } = fields();
    await choose(screen.getByTestId('joint-type'), 'turns between limits');
    expect(joint()).toMatchObject({ type: 'revolute', axis: [0, 0, 1] });
    expect(screen.getByTestId('joint')).toHaveAttribute('open');
    expect(screen.getByText('Limits (°)')).toBeInTheDocument();
    expect(screen.getByTestId('joint-lower')).toHaveValue('-90');
    expect(screen.getByTestId('joint-upper')).toHaveValue('90');
    await write('joint-upper', '45');
    expect(joint().limits?.[1]).toBeCloseTo(Math.PI / 4, 4);
    expect(joint().limits?.[0]).toBeCloseTo(-Math.PI / 2, 4);
    await write('joint-lower', '60');
    expect(joint().limits?.[0]).toBeCloseTo(Math.PI / 4, 4);
    await write('joint-upper', '-100');
    expect(joint().limits?.[1]).toBeCloseTo(Math.PI / 4, 4);
  });

  it('change its axis, part by part', async () => {
    const { joint } = fields(asType('revolute', LIMIT));
    await write('joint-axis-x', '1');
    await write('joint-axis-z', '-4');
    expect(joint().axis.map((part) => Math.round(part))).toEqual([1, 0, -1]);
  });

  it('show the range of a prismatic joint in metres', async () => {
    const { joint } = fields(asType('prismatic', '<limit lower="0" upper="0.3" effort="1" velocity="1"/>'));
    expect(screen.getByText('Limits (m)')).toBeInTheDocument();
    await user.type(screen.getByTestId('joint-upper'), '{ArrowUp}');
    expect(joint().limits).toEqual([0, 0.31]);
  });

  it('step limits by five degrees', async () => {
    const { joint } = fields(asType('revolute', LIMIT));
    await user.type(screen.getByTestId('joint-lower'), '{ArrowUp}');
    expect(joint().limits?.[0]).toBeCloseTo((-85 * Math.PI) / 180, 4);
  });

  it('have no limits for a continuous joint', () => {
    fields(asType('continuous'));
    expect(screen.getByTestId('joint-axis-x')).toBeInTheDocument();
    expect(screen.queryByTestId('joint-lower')).toBeNull();
  });

  it('give it a motor, change it, and remove it', async () => {
    const { robot } = fields(asType('continuous'));
    const motor = () => motorOf(robot(), 'caster_joint');
    expect(screen.queryByTestId('value-topic')).toBeNull();
    await user.click(screen.getByTestId('joint-motor'));
    expect(motor()?.raw).toMatchObject({ topic: '/caster/command' });
    await write('value-topic', '/arm/goal');
    await write('value-torque', '7');
    expect(motor()?.raw).toMatchObject({ topic: '/arm/goal', torque: 7 });
    await user.click(screen.getByTestId('joint-motor'));
    expect(motor()).toBeNull();
  });

  it('cannot change the joint of a driven wheel', () => {
    fields({}, 'wheel_left_joint');
    expect(screen.getByText('Joint · turns without limits')).toBeInTheDocument();
    expect(screen.getByTestId('joint')).not.toHaveAttribute('open');
    expect(screen.queryByTestId('joint-type')).toBeNull();
    expect(screen.queryByTestId('joint-motor')).toBeNull();
  });

  it('show a type that cannot be chosen here', async () => {
    fields(asType('floating'));
    expect(screen.getByText('Joint · floating')).toBeInTheDocument();
    await user.click(screen.getByTestId('joint-type'));
    expect((await screen.findAllByRole('option')).at(-1)).toHaveTextContent('floating');
  });

  it('cannot be edited in a read-only project', () => {
    fields(asType('continuous'), 'caster_joint', lookOnly);
    expect(screen.getByTestId('joint-type')).toBeDisabled();
    expect(screen.getByTestId('joint-motor')).toBeDisabled();
  });
});
