import { IconCheck, IconPlugConnected, IconRobot, IconWorld, type Icon } from '@tabler/icons-react';
import { useId } from 'react';
import type { UniverseInfo } from '@/api/types';
import { OUTSIDE } from './titles';
import classes from './universe.module.css';

/** Choices without a picture: the universe's own robot, the robot template, and no simulated world. */
const WITHOUT_PICTURE: ReadonlyMap<string, Icon> = new Map([
  ['', IconRobot],
  ['template', IconRobot],
  [OUTSIDE, IconPlugConnected],
]);

interface ChoiceCardsProps {
  readonly label: string;
  readonly items: readonly UniverseInfo[];
  readonly chosen: string;
  readonly onChoose: (id: string) => void;
  /** Whether the chosen card gets the focus first in a dialogue. */
  readonly isFirst?: boolean;
}

/** Cards with pictures, of which one is chosen; keyboard and screen readers treat them as radio buttons. */
export function ChoiceCards({ label, items, chosen, onChoose, isFirst = false }: ChoiceCardsProps) {
  const name = useId();
  return (
    <div className={classes['cards']} role="radiogroup" aria-label={label}>
      {items.map(({ id, name: title, description, preview }) => {
        const Symbol = WITHOUT_PICTURE.get(id) ?? IconWorld;
        return (
          <label key={id} className={classes['card']} data-testid={`choice-${id || 'default'}`}>
            <input
              type="radio"
              name={name}
              value={id}
              checked={id === chosen}
              {...(isFirst && id === chosen ? { 'data-autofocus': true } : {})}
              onChange={() => onChoose(id)}
              className={classes['radio']}
            />
            <span className={classes['picture']}>
              {preview ? (
                <img src={preview} alt="" loading="lazy" width={480} height={270} />
              ) : (
                <Symbol size={32} stroke={1.4} aria-hidden="true" />
              )}
              <IconCheck size={18} className={classes['check']} aria-hidden="true" />
            </span>
            <span className={classes['title']}>{title}</span>
            <span className={classes['description']}>{description}</span>
          </label>
        );
      })}
    </div>
  );
}
