import { Tooltip } from '@mantine/core';
import { IconChevronRight } from '@tabler/icons-react';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import { insertOffer } from '@/features/library/insertOffer';
import { useLibrary } from '@/features/library/useReusables';
import { FamilyTile } from '@/ui/FamilyTile';
import classes from './Palette.module.css';

/** The behaviours of the built-in library by their names alone; a click adds one with what it needs. */
export function ReadyBehaviours({ search }: { readonly search: string }) {
  const { t, i18n } = useTranslation('palette');
  const { data = [] } = useLibrary(i18n.language);
  const [isOpen, setOpen] = useState(false);
  const wanted = search.toLowerCase();
  const shown = data.filter(({ id, summary }) => `${id} ${summary}`.toLowerCase().includes(wanted));
  if (shown.length === 0) return null;
  return (
    <div className={classes['group']}>
      <button
        type="button"
        className={classes['groupTitle']}
        aria-expanded={isOpen || wanted !== ''}
        data-testid="ready-behaviours"
        onClick={() => setOpen(!isOpen)}
      >
        <IconChevronRight size={13} aria-hidden="true" />
        {t('ready')}
        <span className={classes['count']}>{shown.length}</span>
      </button>
      {isOpen || wanted !== '' ? (
        <div className={classes['items']}>
          {shown.map((offer) => (
            <Tooltip
              key={offer.id}
              label={offer.summary}
              position="right"
              openDelay={500}
              multiline
              maw={280}
            >
              <button
                type="button"
                className={classes['item']}
                aria-label={t('add', { name: offer.id })}
                onClick={() => insertOffer(offer)}
              >
                <FamilyTile type="SubTree" family="subtree" size={22} />
                <span className={classes['itemName']}>{offer.id}</span>
              </button>
            </Tooltip>
          ))}
        </div>
      ) : null}
    </div>
  );
}
