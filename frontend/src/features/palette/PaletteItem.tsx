import { Tooltip } from '@mantine/core';
import { memo } from 'react';
import { useTranslation } from 'react-i18next';
import { shippedChoice } from '@/i18n/shipped';
import type { Choice } from '@/model/choices';
import { addHere } from '@/store/project/edits/blocks';
import { setEditor } from '@/store/project/editor';
import { usePressed } from '@/ui/hooks/usePressed';
import { FamilyTile } from '@/ui/FamilyTile';
import classes from './Palette.module.css';

/** A block of the palette: a drag adds it where it is dropped, a click adds it where it fits. */
export const PaletteItem = memo(function PaletteItem({ choice }: { readonly choice: Choice }) {
  const { t } = useTranslation('palette');
  const { kind, spec, label } = choice;
  const { isPressed, handlers } = usePressed();
  return (
    <Tooltip
      label={shippedChoice(choice)}
      // The tip would hang over the canvas while the block is dragged.
      disabled={spec.summary === '' || isPressed}
      position="right"
      openDelay={500}
      multiline
      maw={280}
    >
      <button
        type="button"
        className={classes['item']}
        draggable
        data-testid={`palette-${kind.tree ?? kind.type}`}
        aria-label={t('add', { name: label })}
        {...handlers}
        onClick={() => {
          addHere(kind);
        }}
        onDragStart={(event) => {
          event.dataTransfer.effectAllowed = 'copy';
          event.dataTransfer.setData('text/plain', label);
          setEditor({ dragged: kind });
        }}
        onDragEnd={() => {
          setEditor({ dragged: null, slot: null });
          handlers.onPointerLeave();
        }}
      >
        <FamilyTile type={spec.type} family={spec.family} size={22} />
        <span className={classes['itemName']}>{label}</span>
      </button>
    </Tooltip>
  );
});
