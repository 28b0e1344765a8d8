import { Badge, Button, Group, Text } from '@mantine/core';
import { IconChevronRight, IconPlus, IconRefresh } from '@tabler/icons-react';
import { Suspense, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { TreePicture } from '@/features/projects/TreePicture';
import { lazyPart } from '@/ui/parts';
import { insertOffer } from './insertOffer';
import classes from './library.module.css';
import type { Offer } from './useReusables';

const UpdateDialog = lazyPart(async () => (await import('./UpdateDialog')).UpdateDialog);

interface BehaviourRowProps {
  readonly offer: Offer;
  /** Whether the row names the project that the behaviour comes from. */
  readonly namesProject?: boolean;
  /** The version that the project contains; null if it does not contain the behaviour. */
  readonly takenVersion: string | null;
}

/** The row of a behaviour: description, picture, and buttons to add it. */
export function BehaviourRow({ offer, namesProject = false, takenVersion }: BehaviourRowProps) {
  const { t } = useTranslation('library');
  const [isOpen, setOpen] = useState(false);
  const [isUpdating, setUpdating] = useState(false);
  const isOld = takenVersion !== null && takenVersion !== offer.version;
  const files = Object.keys(offer.files);

  return (
    <li className={classes['row']} data-testid={`behaviour-${offer.id}`}>
      <div className={classes['title']}>
        <button
          type="button"
          className={classes['name']}
          aria-expanded={isOpen}
          onClick={() => setOpen(!isOpen)}
        >
          <IconChevronRight size={13} aria-hidden="true" />
          <span>{offer.id}</span>
        </button>
        {isOld ? (
          <Button
            size="compact-xs"
            variant="light"
            data-testid={`update-${offer.id}`}
            leftSection={<IconRefresh size={13} aria-hidden="true" />}
            onClick={() => setUpdating(true)}
          >
            {t('update')}
          </Button>
        ) : null}
        <Button
          size="compact-xs"
          variant="default"
          data-testid={`insert-${offer.id}`}
          aria-label={t('insertNamed', { name: offer.id })}
          leftSection={<IconPlus size={13} aria-hidden="true" />}
          onClick={() => insertOffer(offer)}
        >
          {t('insert')}
        </Button>
      </div>
      {namesProject ? (
        <Text size="xs" className={classes['summary'] ?? ''}>
          {offer.owner === null
            ? t('from', { project: offer.project })
            : t('fromOwner', { project: offer.project, owner: offer.owner })}
        </Text>
      ) : null}
      {offer.summary === '' ? null : (
        <Text size="xs" className={classes['summary'] ?? ''}>
          {offer.summary}
        </Text>
      )}
      {isOpen ? (
        <div className={classes['details']}>
          <div className={classes['picture']}>
            <TreePicture diagram={offer.diagram} />
          </div>
          {offer.doc ? <Text size="xs">{offer.doc}</Text> : null}
          <Group gap={6}>
            <Badge size="sm" variant="light" color="gray" tt="none">
              {offer.project === null
                ? t('version', { version: offer.version })
                : t('asNow', { project: offer.project })}
            </Badge>
            {takenVersion !== null ? (
              <Badge size="sm" variant="light" tt="none">
                {offer.project === null
                  ? t('taken', { version: takenVersion })
                  : t(isOld ? 'takenEarlier' : 'takenNow')}
              </Badge>
            ) : null}
          </Group>
          <Text size="xs" fw={600}>
            {t('brings', { count: files.length })}
          </Text>
          <ul className={classes['files']}>
            {files.map((path) => (
              <li key={path}>{path}</li>
            ))}
          </ul>
        </div>
      ) : null}
      {isUpdating ? (
        <Suspense fallback={null}>
          <UpdateDialog offer={offer} onClose={() => setUpdating(false)} />
        </Suspense>
      ) : null}
    </li>
  );
}
