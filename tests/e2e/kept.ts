/** What the browser has stored of the work, for tests that must not leave a page before it is. */
import type { Page } from '@playwright/test';
import type { Work } from '../../web/src/project/workStore';

/** Null where nothing is stored. */
export function keptWork(page: Page): Promise<Pick<Work, 'history' | 'speech'> | null> {
  return page.evaluate(async () => {
    const answer = <T>(request: IDBRequest<T>) =>
      new Promise<T>((resolve, reject) => {
        request.onsuccess = () => resolve(request.result);
        request.onerror = () => reject(request.error);
      });
    const database = await answer(indexedDB.open('vectortalker'));
    try {
      const stores = database.transaction(['pointer', 'parts']);
      const keys = (await answer(stores.objectStore('pointer').get('current'))) as Record<string, IDBValidKey> | undefined;
      if (!keys) return null;
      const part = (name: string) => answer(stores.objectStore('parts').get(keys[name]));
      return { history: await part('history'), speech: await part('speech') };
    } finally {
      database.close();
    }
  });
}
