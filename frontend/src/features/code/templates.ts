import action from './templates/action.py?raw';
import condition from './templates/condition.py?raw';
import control from './templates/control.py?raw';
import decorator from './templates/decorator.py?raw';
import drive from './templates/drive.py?raw';
import goal from './templates/goal.py?raw';
import service from './templates/service.py?raw';

/** The templates of new actions, in the order of the dialogue. */
const TEMPLATES = { action, drive, condition, service, goal, control, decorator } as const;

export type ActionTemplate = keyof typeof TEMPLATES;

export const ACTION_TEMPLATES = Object.keys(TEMPLATES) as readonly ActionTemplate[];

/** Returns the source of a template, with the action's name as its class. */
export const actionSource = (name: string, template: ActionTemplate): string =>
  TEMPLATES[template].replaceAll('NewAction', name);
