import { shippedChoice } from '@/i18n/shipped';
import type { Choice } from '@/model/choices';
import { FamilyTile } from '@/ui/FamilyTile';
import classes from './QuickAdd.module.css';

interface ChoiceRowProps {
  readonly id: string;
  readonly choice: Choice;
  readonly isActive: boolean;
  readonly onChoose: () => void;
}

export function ChoiceRow({ id, choice, isActive, onChoose }: ChoiceRowProps) {
  return (
    <div id={id} role="option" tabIndex={-1} aria-selected={isActive} className={classes['row']}>
      <button
        type="button"
        tabIndex={-1}
        className={classes['choice']}
        onPointerDown={(event) => {
          // The focus must stay in the search box, since losing it would close the list.
          event.preventDefault();
          onChoose();
        }}
      >
        <FamilyTile type={choice.spec.type} family={choice.spec.family} size={26} />
        <span className={classes['texts']}>
          <span className={classes['label']}>{choice.label}</span>
          <span className={classes['summary']}>{shippedChoice(choice)}</span>
        </span>
      </button>
    </div>
  );
}
