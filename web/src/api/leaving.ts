/** Whether the page is being left. Browsers cut its requests off then, and what they cut off is no failure of the server. */

const STAYED_MILLISECONDS = 10_000; // after that the person has chosen to stay

let leaving = false;

/** Watches for as long as there is a page. */
export function watchLeaving(): void {
  window.addEventListener('beforeunload', () => {
    leaving = true;
    setTimeout(() => {
      leaving = false;
    }, STAYED_MILLISECONDS);
  });
}

/** Settles as `answer` does, but never fails while the page is being left: the work is kept as it stands, to go on after a reload. */
export function unlessLeaving<T>(answer: Promise<T>): Promise<T> {
  return answer.catch((reason: unknown) => (leaving ? new Promise<never>(() => {}) : Promise.reject(reason)));
}
