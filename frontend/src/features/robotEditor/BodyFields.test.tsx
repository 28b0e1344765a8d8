import { act, screen, waitFor, within } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import {
  choose,
  lookOnly,
  openRobot,
  showRobot,
  stl,
  takesFile,
  type,
  URDF,
  write,
} from '../../../harness/documents';
import robotUrdf from '@/model/robot/template/robot.urdf?raw';
import { fakeServer, user } from '../../../harness/testing';
import { bodiesOf } from '@/model/robot/solids';
import { BodyFields } from './BodyFields';

function fields(
  name: string,
  more: { isSized?: boolean; texts?: Record<string, string>; prepare?: () => void } = {},
) {
  const editor = openRobot(more.texts);
  more.prepare?.();
  const robot = showRobot(editor, (now) => (
    <BodyFields editor={editor} robot={now} name={name} isSized={more.isSized ?? true} />
  ));
  const link = () => robot().urdf.links.get(name)!;
  return { editor, robot, link, bodies: () => bodiesOf(link()) };
}

const shape = (at = 0) => screen.getByTestId(`shape-${at}`);

describe('the fields of a body', () => {
  it('change its mass within its range', async () => {
    const { link } = fields('base_link');
    expect(screen.getByTestId('part-mass')).toHaveValue('3');
    await write('part-mass', '5');
    expect(link().mass).toBe(5);
    await write('part-mass', '0');
    expect(link().mass).toBe(0.001);
    await write('part-mass', '2000');
    expect(link().mass).toBe(1000);
  });

  it('change its friction, ahead and sideways', async () => {
    const { robot } = fields('caster_link');
    expect(screen.getByTestId('part-friction')).toHaveValue('0');
    await write('part-friction', '0.5');
    await write('part-friction', '50');
    expect(robot().raw['friction']).toMatchObject({ caster_link: 10 });
    expect(screen.queryByTestId('part-skid')).toBeNull();
  });

  it('have the sideways friction of a wheel, up to 1', async () => {
    const { robot } = fields('wheel_left_link', { isSized: false });
    await write('part-skid', '0.5');
    expect(robot().raw['skid']).toMatchObject({ wheel_left_link: 0.5 });
    await write('part-skid', '3');
    expect(screen.getByTestId('part-skid')).toHaveValue('1');
    expect(screen.queryByTestId('shape-0')).toBeNull();
    expect(screen.queryByTestId('add-body')).toBeNull();
    expect(screen.queryByTestId('shape-0-x')).toBeNull();
  });

  it('have no friction if nothing is touched', () => {
    fields('camera_link');
    expect(screen.queryByTestId('part-friction')).toBeNull();
    expect(screen.queryByTestId('part-skid')).toBeNull();
  });

  it('name each shape, and open it if it is the only one', () => {
    fields('base_link');
    const summary = screen.getByText(/Box · seen and touched/);
    expect(summary.closest('details')).toHaveAttribute('open');
    expect(summary.querySelector('span')).toHaveStyle({ background: 'rgb(63, 111, 181)' });
  });

  it('name shapes that are only visual, or only collision', () => {
    fields('wheel_left_link', { isSized: false });
    expect(screen.getAllByText(/only seen/)).not.toHaveLength(0);
    expect(screen.getByText(/Sphere · only touched/).closest('details')).not.toHaveAttribute('open');
  });

  it('change size and place of a shape, visual and collision together', async () => {
    const { bodies } = fields('base_link');
    await write('shape-0-size-0', '0.5');
    await write('shape-0-z', '0.2');
    await write('shape-0-yaw', '90');
    const [body] = bodies();
    for (const solid of [body!.visual!, body!.collision!]) {
      expect(solid.size).toEqual([0.5, 0.22, 0.1]);
      expect(solid.pose.map((part) => Math.round(part * 1e4) / 1e4)).toEqual([0, 0, 0.2, 0, 0, 1.5708]);
    }
    await write('shape-0-size-2', '0');
    await write('shape-0-size-1', '50');
    expect(bodies()[0]!.visual!.size).toEqual([0.5, 10, 0.001]);
  });

  it('change the kind of a shape', async () => {
    const { bodies } = fields('base_link');
    expect(screen.getByText('Size (m)')).toBeInTheDocument();
    await choose(shape(), 'Cylinder');
    expect(bodies()[0]!.visual).toMatchObject({ shape: 'cylinder', size: [0.15, 0.1] });
    expect(screen.getByTestId('shape-0-size-1')).toBeInTheDocument();
    expect(screen.queryByTestId('shape-0-size-2')).toBeNull();
  });

  it('offer a mesh if there is one, and then the choice of mesh', async () => {
    const texts = { 'robots/mine/meshes/a.stl': '', 'robots/mine/meshes/b.stl': '' };
    const { bodies } = fields('base_link', { texts });
    expect(screen.queryByTestId('shape-0-file')).toBeNull();
    await choose(shape(), 'Mesh');
    expect(bodies()[0]!.visual).toMatchObject({ shape: 'mesh', file: 'meshes/a.stl', size: [1, 1, 1] });
    expect(screen.getByText('Scale')).toBeInTheDocument();
    await choose(screen.getByTestId('shape-0-file'), 'meshes/b.stl');
    expect(bodies()[0]!.visual?.file).toBe('meshes/b.stl');
  });

  it('offer no mesh if there is none', async () => {
    fields('base_link');
    await user.click(shape());
    expect((await screen.findAllByRole('option')).map(({ textContent }) => textContent)).toEqual([
      'Box',
      'Cylinder',
      'Sphere',
    ]);
  });

  it('set the colour, one undo step each', async () => {
    const { editor, bodies } = fields('base_link');
    const color = screen.getByRole('textbox', { name: 'Colour' });
    expect(color).toHaveValue('#3f6fb5');
    for (const wish of ['#ff0000', '#00ff00']) {
      await user.clear(color);
      await user.type(color, wish);
    }
    expect(bodies()[0]!.visual?.color).toEqual([0, 1, 0, 1]);
    expect(editor.store.getState().undoStack.past).toHaveLength(2);
    act(() => {
      color.blur();
    });
    expect(editor.store.getState().undoStack.sealed).toBe(true);
  });

  it('keep the transparency of the colour', async () => {
    const texts = { [URDF]: robotUrdf.replace('0.247 0.435 0.71 1', '0.247 2 -1 0.5') };
    const { bodies } = fields('base_link', { texts });
    const color = screen.getByRole('textbox', { name: 'Colour' });
    expect(color).toHaveValue('#3fff00');
    await type(color, '#ff0000');
    expect(bodies()[0]!.visual?.color).toEqual([1, 0, 0, 0.5]);
  });

  it('add and remove shapes, but keep the last one of the base', async () => {
    const { bodies } = fields('base_link');
    await user.click(screen.getByTestId('add-body'));
    expect(bodies()).toHaveLength(2);
    expect(bodies()[1]!.visual?.shape).toBe('box');
    const remove = () => screen.getAllByRole('button', { name: 'Remove this shape' });
    await user.click(remove()[0]!);
    expect(bodies()).toHaveLength(1);
    await user.click(remove()[0]!);
    expect(bodies()).toHaveLength(1);
  });

  it('upload a mesh for it', async () => {
    const { bodies } = fields('base_link');
    const input = screen.getByTestId('body-mesh-file');
    const opened = vi.spyOn(input, 'click').mockImplementation(() => undefined);
    await user.click(screen.getByTestId('bring-body-mesh'));
    expect(opened).toHaveBeenCalledOnce();
    fakeServer(takesFile('robots/mine/meshes/arm.stl'));
    await user.upload(input, new File([stl(1)], 'arm.stl'));
    await waitFor(() =>
      expect(bodies().at(-1)?.visual).toMatchObject({ shape: 'mesh', file: 'meshes/arm.stl' }),
    );
  });

  it('cannot be edited in a read-only project', () => {
    fields('base_link', { prepare: lookOnly });
    expect(screen.queryByTestId('add-body')).toBeNull();
    expect(screen.queryByRole('button', { name: 'Remove this shape' })).toBeNull();
    expect(shape()).toBeDisabled();
    expect(within(screen.getByRole('group', { name: 'Body' })).getByTestId('part-mass')).toBeDisabled();
  });

  it('are empty for a missing link', () => {
    fields('gone');
    expect(screen.queryByTestId('part-mass')).toBeNull();
  });
});
