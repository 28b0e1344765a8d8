import { beforeEach, describe, expect, it } from 'vitest';
import { fileFixes, type Fix } from '@/model/fixes';
import { openProject, watchNavigation } from '../../../../harness/testing';
import { useProjectStore } from '../index';
import { applyFix } from './fixes';

const ACTION = 'actions/DetectLine.py';
const UNIVERSE = 'universes/own.yaml';
const SOURCE = "TOPIC = '/cam_f1_left/image_raw'\n";
const VALUES = {
  name: 'DetectLine',
  topic: '/cam_f1_left/image_raw',
  said: '/cam_f1_left/image_raw',
  sensor: 'camera',
  other: '/camera/image_raw',
};
const text = (path: string) => useProjectStore.getState().currentText(path);
const only = (fixes: readonly Fix[], key: string): Fix => {
  const found = fixes.find((each) => each.key === key);
  if (!found) throw new Error(`no fix ${key}`);
  return found;
};

it('leads to the field in which a value is typed, and changes nothing', async () => {
  const { focusField, openTree } = watchNavigation();
  openProject({ trees: { Dock: { r: { type: 'Sequence', children: ['d'] }, d: { type: 'Sleep' } } } });
  const before = useProjectStore.getState().diagrams;
  const fix: Fix = { key: 'type-value', does: { makes: 'typing', node: 'd', port: 'msec' }, values: {} };
  expect(await applyFix('Dock', fix)).toBeNull();
  expect(useProjectStore.getState()).toMatchObject({ diagrams: before, selection: ['d'] });
  expect(openTree).toHaveBeenCalledExactlyOnceWith('Dock');
  expect(focusField).toHaveBeenCalledExactlyOnceWith('msec');
});

describe('fixes of a topic that nobody publishes', () => {
  beforeEach(() => {
    openProject({
      texts: { [ACTION]: SOURCE, [UNIVERSE]: 'name: U\nrobots:\n  - {id: r, model: waffle}\n' },
    });
  });

  it('has none for other findings, and none without the values', () => {
    expect(fileFixes('BT0624', ACTION, 1, VALUES)).toEqual([]);
    expect(fileFixes('BT0623', ACTION, 1, {})).toEqual([]);
  });

  it('writes the topic of the sensor into the action, and takes it back', async () => {
    const fixes = fileFixes('BT0623', ACTION, 1, { ...VALUES, universe: '' });
    expect(fixes.map(({ key }) => key)).toEqual(['use-topic']);
    const undo = await applyFix('', only(fixes, 'use-topic'));
    expect(text(ACTION)).toBe("TOPIC = '/camera/image_raw'\n");
    undo?.();
    expect(text(ACTION)).toBe(SOURCE);
  });

  it('gives the sensor the topic in the universe of the project', async () => {
    const fix = only(fileFixes('BT0623', ACTION, 1, { ...VALUES, universe: UNIVERSE }), 'remap-topic');
    expect(await applyFix('', fix)).not.toBeNull();
    expect(text(UNIVERSE)).toContain('topics: {camera: /cam_f1_left/image_raw}');
  });

  it('does nothing where the file is gone', async () => {
    const fix = only(fileFixes('BT0623', 'actions/Gone.py', 1, { ...VALUES, universe: '' }), 'use-topic');
    expect(await applyFix('', fix)).toBeNull();
  });

  it('changes the call at the line alone: ports, keys and publishers of that name stay', async () => {
    const call = (topic: string) =>
      `KEY = "scan"\nself.create_subscription(\n    Laser(),\n    "${topic}",\n)\nself.create_publisher(Laser, "scan")\n`;
    useProjectStore.getState().setFileText(ACTION, call('scan'));
    const values = { ...VALUES, said: 'scan', universe: '' };
    await applyFix('', only(fileFixes('BT0623', ACTION, 2, values), 'use-topic'));
    expect(text(ACTION)).toBe(call('/camera/image_raw'));
  });

  it('changes nothing where the name is not at the line and stands twice', async () => {
    const source = 'PORT = "scan"\nTOPIC = "scan"\nself.create_subscription(Laser, TOPIC)\n';
    useProjectStore.getState().setFileText(ACTION, source);
    const values = { ...VALUES, said: 'scan', universe: '' };
    expect(await applyFix('', only(fileFixes('BT0623', ACTION, 3, values), 'use-topic'))).toBeNull();
    expect(text(ACTION)).toBe(source);
  });

  it('is not taken back over what was typed since, nor in another project', async () => {
    const fix = only(fileFixes('BT0623', ACTION, 1, { ...VALUES, universe: '' }), 'use-topic');
    const undo = await applyFix('', fix);
    const fixed = text(ACTION) ?? '';
    useProjectStore.getState().setFileText(ACTION, `${fixed}# more\n`);
    expect(undo?.()).toBe(false);
    expect(text(ACTION)).toBe(`${fixed}# more\n`);
    useProjectStore.getState().setFileText(ACTION, fixed);
    useProjectStore.setState({ projectId: 'another' });
    expect(undo?.()).toBe(false);
    expect(text(ACTION)).toBe(fixed);
  });
});
