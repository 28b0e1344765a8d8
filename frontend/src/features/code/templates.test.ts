import { expect, it } from 'vitest';
import { ACTION_TEMPLATES, actionSource } from './templates';

it('offers an action first', () => {
  expect(ACTION_TEMPLATES).toEqual([
    ...['action', 'drive', 'condition', 'service', 'goal'],
    ...['control', 'decorator'],
  ]);
});

it.each(ACTION_TEMPLATES)('names the class of the template “%s” after its file', (kind) => {
  const source = actionSource('FollowWall', kind);
  const base = { control: 'ControlNode', decorator: 'DecoratorNode' }[kind as string];
  expect(source).toContain(`class FollowWall(${base ?? 'py_trees.behaviour.Behaviour'}):`);
  expect(source).not.toContain('NewAction');
});

it('has a different text for each', () => {
  expect(new Set(ACTION_TEMPLATES.map((kind) => actionSource('Go', kind))).size).toBe(
    ACTION_TEMPLATES.length,
  );
  expect(actionSource('Go', 'condition')).toContain('NODE_KIND = "Condition"');
  expect(actionSource('Go', 'action')).not.toContain('NODE_KIND = "Condition"');
});
