import action from './templates/action.py?raw';
import condition from './templates/condition.py?raw';
import control from './templates/control.py?raw';
import decorator from './templates/decorator.py?raw';
import goal from './templates/goal.py?raw';
import service from './templates/service.py?raw';

/** Templates of new actions, in the order in which they are offered. */
const TEMPLATES = { action, condition, service, goal, control, decorator } as const;

export type ActionTemplate = keyof typeof TEMPLATES;

export const ACTION_TEMPLATES = Object.keys(TEMPLATES) as readonly ActionTemplate[];

/** Returns a template whose class has the action's name. */
export const actionSource = (name: string, template: ActionTemplate): string =>
  TEMPLATES[template].replaceAll('NewAction', name);
