import { describe, expect, it, vi } from 'vitest';
import { parseTry } from '@/model/lesson/parse';
import { useProjectStore } from '@/store/project';
import { runProject } from '@/store/run/run';
import { action, nodeOf, openProject, port, watchNavigation } from '../../../harness/testing';
import { perform } from './perform';

vi.mock('@/store/run/run', () => ({ runProject: vi.fn(() => Promise.resolve(true)) }));

function open() {
  openProject({
    trees: { Main: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Go', ports: { speed: '0.3' } } } },
    actions: [action('Go', { ports: [port('speed', 'double'), port('far', 'double')] })],
    texts: { 'actions/Go.py': 'pass\n' },
  });
  useProjectStore.getState().setActiveTree('Main');
  return watchNavigation();
}

const tried = (address: string) => perform(parseTry(address)!);

describe('perform', () => {
  it('selects a block and brings its tree to the front', () => {
    const { openTree } = open();
    expect(tried('try:select=Go')).toEqual({ kind: 'selected', values: { block: 'Go' } });
    expect(openTree).toHaveBeenCalledWith('Main');
    expect(useProjectStore.getState()).toMatchObject({ selection: ['a'], revealed: { node: 'a' } });
  });

  it('sets a port in one step of undo, also one without a value before', () => {
    open();
    expect(tried('try:set=Go.speed=0.15').kind).toBe('set');
    expect(tried('try:set=Go.far=2').kind).toBe('set');
    expect(nodeOf('Main', 'a')?.ports).toEqual({ speed: '0.15', far: '2' });
    useProjectStore.getState().undo();
    expect(nodeOf('Main', 'a')?.ports).toEqual({ speed: '0.15' });
    useProjectStore.getState().undo();
    expect(nodeOf('Main', 'a')?.ports).toEqual({ speed: '0.3' });
  });

  it('opens a line of a file of the project', () => {
    const { openFile } = open();
    expect(tried('try:open=actions/Go.py:12').kind).toBe('opened');
    expect(openFile).toHaveBeenCalledWith('actions/Go.py', 12);
  });

  it('runs the project', () => {
    open();
    expect(tried('try:run').kind).toBe('running');
    expect(runProject).toHaveBeenCalledOnce();
  });

  it.each([
    ['try:select=Gone', 'noBlock'],
    ['try:set=Gone.speed=1', 'noBlock'],
    ['try:set=Go.lost=1', 'noPort'],
    ['try:open=actions/Gone.py', 'noFile'],
  ])('reports what is missing for %s, and changes nothing', (address, kind) => {
    open();
    const { changeCounter } = useProjectStore.getState();
    expect(tried(address).kind).toBe(kind);
    expect(useProjectStore.getState().changeCounter).toBe(changeCounter);
  });

  it('changes nothing for a viewer', () => {
    open();
    useProjectStore.setState({ role: 'viewer' });
    expect(tried('try:set=Go.speed=1').kind).toBe('readOnly');
    expect(nodeOf('Main', 'a')?.ports?.['speed']).toBe('0.3');
  });
});
