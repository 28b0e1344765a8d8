import { IconChevronRight } from '@tabler/icons-react';
import { useState } from 'react';
import type { Choice } from '@/model/choices';
import { PaletteItem } from './PaletteItem';
import classes from './Palette.module.css';

interface PaletteGroupProps {
  readonly title: string;
  readonly choices: readonly Choice[];
  readonly isSearching: boolean;
  /** Whether the group is folded at first, since it is long and few projects need it. */
  readonly startsFolded?: boolean;
  /** The text for an empty group while the search is empty. */
  readonly empty?: string;
}

/** A family of the palette, which can be folded; a search unfolds it. */
export function PaletteGroup({
  title,
  choices,
  isSearching,
  startsFolded = false,
  empty,
}: PaletteGroupProps) {
  const [isOpen, setIsOpen] = useState(!startsFolded);
  if (choices.length === 0 && (empty === undefined || isSearching)) return null;
  const open = isOpen || isSearching;
  return (
    <div className={classes['group']}>
      <button
        type="button"
        className={classes['groupTitle']}
        aria-expanded={open}
        onClick={() => {
          setIsOpen(!isOpen);
        }}
      >
        <IconChevronRight size={13} aria-hidden="true" />
        {title}
        <span className={classes['count']}>{choices.length}</span>
      </button>
      {open && (
        <div className={classes['items']}>
          {choices.map((choice) => (
            <PaletteItem key={`${choice.kind.type}/${choice.kind.tree ?? ''}`} choice={choice} />
          ))}
          {choices.length === 0 && <p className={classes['nothing']}>{empty}</p>}
        </div>
      )}
    </div>
  );
}
