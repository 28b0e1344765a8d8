import { ActionIcon } from '@mantine/core';
import { IconX } from '@tabler/icons-react';
import { useEffect, useId, useRef, useState, type KeyboardEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { openPlace, type Place } from '../language/places';
import { closeReferences, useReferences, type References } from '../language/references';
import { PlaceText } from './PlaceText';
import classes from './places.module.css';
import { usePlacesText } from './usePlacesText';

interface ReferencesPanelProps {
  /** Returns the keyboard to the editor. */
  readonly onLeave: () => void;
}

/** The places where a name is used, by file, below the editor. */
export function ReferencesPanel({ onLeave }: ReferencesPanelProps) {
  const found = useReferences((state) => state.found);
  return found ? <Found key={found.request} found={found} onLeave={onLeave} /> : null;
}

function Found({ found, onLeave }: ReferencesPanelProps & { readonly found: References }) {
  const { t } = useTranslation('code');
  const summary = usePlacesText();
  const { name, client, groups } = found;
  const places = groups.flatMap((group) => group.places);
  const [chosen, setChosen] = useState(0);
  const list = useRef<HTMLDivElement>(null);
  const base = useId();
  const id = (at: number) => `${base}-${at}`;
  const close = () => {
    closeReferences();
    onLeave();
  };

  useEffect(() => {
    // Hidden editors contain the list too; only a visible list can take the keyboard focus.
    list.current?.focus({ preventScroll: true });
  }, []);
  useEffect(() => {
    list.current?.querySelector('[aria-selected="true"]')?.scrollIntoView({ block: 'nearest' });
  }, [chosen]);

  const open = (at: number) => {
    const place = places[at];
    setChosen(at);
    if (place) void openPlace(client, place);
  };
  const onKeyDown = (event: KeyboardEvent) => {
    const to = STEPS[event.key]?.(chosen, places.length);
    if (to !== undefined) setChosen(Math.max(0, Math.min(places.length - 1, to)));
    else if (event.key === 'Enter') open(chosen);
    else if (event.key === 'Escape') close();
    else return;
    event.preventDefault();
    event.stopPropagation();
  };

  return (
    <section
      className={classes['panel']}
      aria-label={t('references.title', { name })}
      data-testid="references"
    >
      <div className={classes['head']}>
        <h2 className={classes['title']}>{t('references.title', { name })}</h2>
        <span className={classes['count']} role="status">
          {places.length === 0 ? t('references.none') : summary(groups)}
        </span>
        <ActionIcon aria-label={t('references.close')} onClick={close}>
          <IconX size={16} />
        </ActionIcon>
      </div>
      <div
        ref={list}
        className={classes['list']}
        role="listbox"
        tabIndex={0}
        aria-label={t('references.title', { name })}
        aria-activedescendant={places.length > 0 ? id(chosen) : undefined}
        onKeyDown={onKeyDown}
      >
        {groups.map((group) => (
          <div key={group.uri} role="group" aria-label={group.name}>
            <div className={classes['file']} role="presentation">
              {group.name}
              {group.isOutside ? <span className={classes['outside']}>{t('references.outside')}</span> : null}
            </div>
            {group.places.map((place) => (
              <Row
                key={`${place.line}:${place.from}`}
                id={id(places.indexOf(place))}
                place={place}
                isChosen={places[chosen] === place}
                onOpen={() => open(places.indexOf(place))}
              />
            ))}
          </div>
        ))}
      </div>
    </section>
  );
}

/** Returns the index of the choice after a key, in a list of the given length. */
const STEPS: Readonly<Record<string, (at: number, count: number) => number>> = {
  ArrowDown: (at) => at + 1,
  ArrowUp: (at) => at - 1,
  PageDown: (at) => at + 8,
  PageUp: (at) => at - 8,
  Home: () => 0,
  End: (_at, count) => count - 1,
};

interface RowProps {
  readonly id: string;
  readonly place: Place;
  readonly isChosen: boolean;
  readonly onOpen: () => void;
}

function Row({ id, place, isChosen, onOpen }: RowProps) {
  return (
    // The list handles the keys.
    // eslint-disable-next-line jsx-a11y/click-events-have-key-events, jsx-a11y/interactive-supports-focus
    <div id={id} role="option" aria-selected={isChosen} className={classes['place']} onClick={onOpen}>
      <PlaceText place={place} />
    </div>
  );
}
